#include "render/job/still.h"

#include "render/raster/canvas.h"
#include "src/sim/error.h"

#include <cmath>
#include <unordered_map>

#include <fmt/format.h>

namespace offstage {

Still drawStill(SceneSource& source, double at, int strobe) {
  const Clock& clock = source.clock();
  if (!(at >= 0.0 && at <= clock.duration() + 1e-9))
    throw Error(ExitCode::BadInput,
                fmt::format("--at {} does not lie within the scene's 0 … {} s", at, clock.duration()));

  Picture picture;
  source.painter().begin(picture);
  std::unordered_map<std::uint32_t, Vec2> drawnAt; // last drawn position by body
  for (int moment = 0; moment < strobe; ++moment) {
    const double share = strobe == 1 ? 1.0 : static_cast<double>(moment) / static_cast<double>(strobe - 1);
    const std::int64_t frame = clock.frameAt(at * share + 1e-9);
    while (source.frame() < frame) source.step();
    for (const Body& body : source.bodies()) {
      const auto [place, isNew] = drawnAt.try_emplace(body.id, body.position);
      if (!isNew && place->second == body.position) continue;
      place->second = body.position;
      source.painter().body(picture, body, body.look);
    }
  }

  Still still;
  still.alpha = picture.background.a != 255;
  Canvas canvas(picture.width, picture.height);
  canvas.draw(picture, still.frame);
  return still;
}

} // namespace offstage
