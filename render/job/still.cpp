#include "render/job/still.h"

#include "render/raster/canvas.h"
#include "src/sim/error.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>

#include <fmt/format.h>

namespace offstage {

namespace {

constexpr double kRounding = 1e-9; ///< s: a moment that is a frame's time up to rounding is meant to be it

} // namespace

double videoSeconds(const Source& source) {
  return source.film() != nullptr ? source.film()->seconds : source.clock().duration();
}

Shot shotAt(const Source& source, double at) {
  const Film* film = source.film();
  const bool retimed = film != nullptr && film->map;
  const double end = videoSeconds(source);
  if (!(at >= 0.0 && at <= end + kRounding))
    throw Error(ExitCode::BadInput, fmt::format("--at {} does not lie within the {}'s 0 … {} s", at,
                                                retimed ? "video" : "scene", end));
  if (!retimed) {
    const std::int64_t frame = source.clock().frameAt(at + kRounding);
    return {{frame, 0.0}, source.clock().time(frame)};
  }
  const auto frame = static_cast<std::int64_t>(std::floor((at + kRounding) * film->fps));
  return {film->moment(frame), static_cast<double>(frame) / film->fps};
}

namespace {

/// Moments from the video's beginning to `at`, later ones on top.
void drawMoments(SceneSource& source, double at, int count, Picture& picture) {
  std::unordered_map<std::uint32_t, Vec2> drawnAt; // last drawn position by body
  static_cast<void>(shotAt(source, at));
  for (int moment = 0; moment < count; ++moment) {
    const double share = static_cast<double>(moment) / static_cast<double>(count - 1);
    source.show(shotAt(source, at * share));
    if (moment == 0) source.painter().begin(picture);
    for (const Body& body : source.shownBodies()) {
      const auto [place, isNew] = drawnAt.try_emplace(body.id, body.position);
      if (!isNew && place->second == body.position) continue;
      place->second = body.position;
      source.painter().body(picture, body, body.look);
    }
  }
}

} // namespace

Frame drawFrame(Source& source, double at) {
  source.show(shotAt(source, at));
  Picture picture;
  source.draw(picture);
  Canvas canvas(picture.width, picture.height);
  Frame frame;
  canvas.draw(picture, frame);
  return frame;
}

Still drawStill(SceneSource& source, double at, int strobe) {
  Picture picture;
  if (strobe == 1) {
    source.show(shotAt(source, at));
    source.draw(picture);
  } else {
    drawMoments(source, at, strobe, picture);
    source.drawTexts(picture); // of the last moment
  }
  Still still;
  still.alpha = picture.background.a != 255;
  Canvas canvas(picture.width, picture.height);
  canvas.draw(picture, still.frame);
  return still;
}

} // namespace offstage
