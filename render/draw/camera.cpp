#include "render/draw/camera.h"

#include <algorithm>

namespace offstage {

double eased(Easing easing, double u) {
  switch (easing) {
  case Easing::Linear:
    return u;
  case Easing::In:
    return u * u;
  case Easing::Out:
    return 1.0 - (1.0 - u) * (1.0 - u);
  case Easing::Smooth:
    break;
  }
  return u * u * (3.0 - 2.0 * u);
}

std::vector<std::uint32_t> Camera::followed() const {
  std::vector<std::uint32_t> bodies;
  for (const CameraMove& move : moves_)
    if (move.center.body) bodies.push_back(*move.center.body);
  return bodies;
}

Viewport Camera::at(double time, const Viewport& home, const PositionOf& positionOf) const {
  Vec2 center = pane_ * 0.5;
  double size = 1.0; // of the rectangle that is seen, in panes
  bool moved = false;
  for (const CameraMove& move : moves_) {
    if (time < move.at) break;
    const double share = move.length > 0.0 ? std::min((time - move.at) / move.length, 1.0) : 1.0;
    const double u = eased(move.easing, share);
    const Vec2 target = move.center.body ? positionOf(*move.center.body) : move.center.point;
    center += (target - center) * u;
    size += (1.0 / move.zoom - size) * u;
    moved = true;
  }
  if (!moved) return home;
  Viewport viewport = home;
  viewport.scale = home.scale / size;
  viewport.offset = home.offset + pane_ * (0.5 * home.scale) - center * viewport.scale;
  return viewport;
}

Vec2 shownAt(const Vec2& point, const Viewport& home, const Viewport& camera) {
  if (camera.scale == home.scale && camera.offset == home.offset) return point;
  return (point * camera.scale + camera.offset - home.offset) / home.scale;
}

} // namespace offstage
