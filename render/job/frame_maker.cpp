#include "render/job/frame_maker.h"

#include <fmt/format.h>

namespace offstage {

Picture pictureOf(const Source& source) {
  Picture picture;
  source.draw(picture);
  return picture;
}

FrameMaker::FrameMaker(Source& source, const Schedule& schedule)
    : source_(source),
      schedule_(schedule),
      picture_(pictureOf(source)),
      canvas_(picture_.width, picture_.height) {}

const Frame& FrameMaker::make(std::int64_t index) {
  const Shot shot = schedule_.shot(index);
  source_.show(shot);
  if (shot.moment != drawn_ || source_.followsVideoTime()) {
    source_.draw(picture_);
    canvas_.draw(picture_, frame_);
    drawn_ = shot.moment;
  }
  return frame_;
}

std::string FrameMaker::hashLine() const {
  return fmt::format("{} {:016x} {:016x}\n", drawn_.value().frame, source_.shownStateHash(), frame_.hash());
}

} // namespace offstage
