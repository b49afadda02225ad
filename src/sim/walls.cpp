#include "src/sim/walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace offstage {
namespace {

/// Takes at most `most` from a speed.
void rub(double most, double& speed) {
  speed -= std::clamp(speed, -most, most);
}

/// Whether a body touches no edge, as most do not.
bool isInside(const Vec2& pane, const Body& body) {
  const Vec2& at = body.position;
  const bool circle = body.shape == Shape::Circle;
  const double before = circle ? body.radius : 0.0;
  const double right = circle ? body.radius : body.size.x();
  const double lower = circle ? body.radius : body.size.y();
  return at.x() - before > 0.0 && at.y() - before > 0.0 && at.x() + right < pane.x() &&
         at.y() + lower < pane.y();
}

} // namespace

Reach reachOf(const Body& body, int axis) {
  if (body.shape == Shape::Circle) return {body.radius, body.radius};
  return {0.0, body.size[axis]};
}

void bounceOffWalls(const Walls& walls, const Vec2& pane, Body& body, const Event& stamp,
                    std::vector<Event>& events) {
  static constexpr std::array<EventKind, 4> kKinds{EventKind::Left, EventKind::Right, EventKind::Top,
                                                   EventKind::Bottom};
  if (isInside(pane, body)) return;
  for (std::size_t side = 0; side < kKinds.size(); ++side) {
    const std::optional<double>& k = walls.restitution[side];
    if (!k) continue;
    const int axis = side < 2 ? 0 : 1;
    const bool lower = side % 2 == 0; // the edge at coordinate 0
    const auto [before, after] = reachOf(body, axis);
    double& x = body.position[axis];
    double& v = body.velocity[axis];
    const bool touches = lower ? x - before <= 0.0 : x + after >= pane[axis];
    if (!touches || (walls.clamp && !(lower ? v < 0.0 : v > 0.0))) continue;
    Event event = stamp;
    event.kind = kKinds[side];
    event.first = body.id;
    event.p = x;
    event.q = v;
    events.push_back(event);
    if (walls.clamp) x = lower ? before : pane[axis] - after;
    if (body.friction > 0.0)
      rub(body.friction * (1.0 + *k * body.restitution) * std::abs(v), body.velocity[1 - axis]);
    v = -v * (*k * body.restitution);
  }
}

bool isOutside(const Vec2& pane, const Body& body) {
  for (int axis = 0; axis < 2; ++axis) {
    const auto [before, after] = reachOf(body, axis);
    const double x = body.position[axis];
    if (x + after < 0.0 || x - before > pane[axis]) return true;
  }
  return false;
}

} // namespace offstage
