#include "render/job/still.h"

#include "render/raster/canvas.h"
#include "src/sim/error.h"

#include <cmath>

#include <fmt/format.h>

namespace offstage {

namespace {

constexpr double kRounding = 1e-9; ///< s: a moment that is a frame's time up to rounding is meant to be it

} // namespace

double videoSeconds(const Source& source) {
  return source.film() != nullptr ? source.film()->seconds : source.clock().duration();
}

Shot shotAt(const Source& source, double at, std::optional<double> fps) {
  const Film* film = source.film();
  const bool retimed = film != nullptr && film->map;
  const double end = videoSeconds(source);
  if (!(at >= 0.0 && at <= end + kRounding))
    throw Error(ExitCode::BadInput, fmt::format("--at {} does not lie within the {}'s 0 … {} s", at,
                                                retimed ? "video" : "scene", end));
  if (!retimed) {
    if (fps && !source.clock().isFixed()) at = std::floor((at + kRounding) * *fps) / *fps;
    const std::int64_t frame = source.clock().frameAt(at + kRounding);
    return {{frame, 0.0}, source.clock().time(frame)};
  }
  const auto frame = static_cast<std::int64_t>(std::floor((at + kRounding) * film->fps));
  return {film->moment(frame), static_cast<double>(frame) / film->fps};
}

Frame drawFrame(Source& source, double at) {
  source.show(shotAt(source, at));
  Picture picture;
  source.draw(picture);
  Canvas canvas(picture.width, picture.height);
  Frame frame;
  canvas.draw(picture, frame);
  return frame;
}

Still drawStill(SceneSource& source, double at, int strobe, std::optional<double> fps) {
  // Moments from the video's beginning to `at`, later ones on top.
  for (int moment = 0; moment < strobe; ++moment) {
    const double share = strobe == 1 ? 1.0 : static_cast<double>(moment) / static_cast<double>(strobe - 1);
    source.show(shotAt(source, at * share, fps));
    if (strobe > 1) source.keepMoment();
  }
  Picture picture;
  source.draw(picture);

  Still still;
  still.alpha = picture.background.a != 255;
  Canvas canvas(picture.width, picture.height);
  canvas.draw(picture, still.frame);
  return still;
}

} // namespace offstage
