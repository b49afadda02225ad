#include "render/job/still.h"

#include "render/raster/canvas.h"
#include "src/sim/error.h"

#include <cmath>

#include <fmt/format.h>

namespace offstage {

namespace {

constexpr double kRounding = 1e-9; ///< s: a moment that is a frame's time up to rounding is meant to be it

void requireWithin(const Clock& clock, double at) {
  if (at >= 0.0 && at <= clock.duration() + kRounding) return;
  throw Error(ExitCode::BadInput,
              fmt::format("--at {} does not lie within the scene's 0 … {} s", at, clock.duration()));
}

} // namespace

Frame drawFrame(Source& source, double at) {
  requireWithin(source.clock(), at);
  const std::int64_t wanted = source.clock().frameAt(at + kRounding);
  while (source.frame() < wanted) source.step();
  Picture picture;
  source.draw(picture);
  Canvas canvas(picture.width, picture.height);
  Frame frame;
  canvas.draw(picture, frame);
  return frame;
}

Still drawStill(SceneSource& source, double at, int strobe) {
  const Clock& clock = source.clock();
  requireWithin(clock, at);

  for (int moment = 0; moment < strobe; ++moment) {
    const double share = strobe == 1 ? 1.0 : static_cast<double>(moment) / static_cast<double>(strobe - 1);
    const std::int64_t frame = clock.frameAt(at * share + kRounding);
    while (source.frame() < frame) source.step();
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
