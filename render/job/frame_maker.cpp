#include "render/job/frame_maker.h"

#include <string>

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
  const std::int64_t wanted = schedule_.simulated(index);
  while (source_.frame() < wanted) source_.step();
  if (wanted != drawn_) {
    source_.draw(picture_);
    canvas_.draw(picture_, frame_);
    drawn_ = wanted;
  }
  return frame_;
}

std::string FrameMaker::hashLine() const {
  return fmt::format("{} {:016x} {:016x}\n", drawn_, source_.stateHash(), frame_.hash());
}

} // namespace offstage
