#include "src/sim/impact_time.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace offstage {
namespace {

/// Overlaps below this share of the bodies' size are what rounding makes of a touch.
constexpr double kTouching = 1e-9;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// When a point at d from a disc's centre, moving at w, gets into it; never when it only grazes, and at once
/// when it touches and goes in.
double entersDisc(const Vec2& d, const Vec2& w, double radius) {
  const double along = dot(d, w);
  const double distance = length(d);
  if (!(along < 0.0) || !(distance >= radius * (1.0 - kTouching))) return kNever;
  const double c = std::max(distance - radius, 0.0) * (distance + radius);
  // The discriminant (d·w)² − (w·w)·c is (radius·|w|)² − (d×w)², which keeps its digits near a graze.
  const double sweep = radius * length(w);
  const double cross = std::abs(d.x() * w.y() - d.y() * w.x());
  if (!(sweep > cross)) return kNever;
  return c / (std::sqrt((sweep - cross) * (sweep + cross)) - along);
}

std::optional<Impact> ofCircles(const Body& first, const Body& second, const Vec2& w) {
  const Vec2 d = second.position - first.position;
  const double time = entersDisc(d, w, first.radius + second.radius);
  if (time == kNever) return std::nullopt;
  const Vec2 apart = d + w * time;
  return Impact{time, apart / length(apart)};
}

/// With w the circle's velocity as the rectangle sees it, and the normal from the rectangle to the circle.
std::optional<Impact> ofRectangleAndCircle(const Body& rectangle, const Body& circle, const Vec2& w) {
  const Vec2& low = rectangle.position;
  const Vec2 high = low + rectangle.size;
  const double r = circle.radius;
  const Vec2 outside = circle.position - circle.position.cwiseMax(low).cwiseMin(high);
  const bool inside = outside == Vec2::Zero() && (circle.position.array() > low.array()).all() &&
                      (circle.position.array() < high.array()).all();
  if (inside || length(outside) < r * (1.0 - kTouching)) return std::nullopt;
  Impact impact{kNever, Vec2::Zero()};
  for (int axis = 0; axis < 2; ++axis) {
    const int other = 1 - axis;
    if (w[axis] == 0.0) continue;
    const double sign = w[axis] > 0.0 ? -1.0 : 1.0; // of the side that it can meet
    const double side = w[axis] > 0.0 ? low[axis] - r : high[axis] + r;
    const double gap = (circle.position[axis] - side) * sign;
    if (!(gap >= -kTouching * (r + rectangle.size[axis]))) continue;
    const double time = std::max(gap, 0.0) / std::abs(w[axis]);
    const double across = circle.position[other] + w[other] * time;
    if (!(time < impact.time && across >= low[other] && across <= high[other])) continue;
    impact.time = time;
    impact.normal = Vec2::Zero();
    impact.normal[axis] = sign;
  }
  for (const double x : {low.x(), high.x()}) {
    for (const double y : {low.y(), high.y()}) {
      const Vec2 d = circle.position - Vec2(x, y);
      const double time = entersDisc(d, w, r);
      if (!(time < impact.time)) continue;
      const Vec2 apart = d + w * time;
      impact = {time, apart / length(apart)};
    }
  }
  if (impact.time == kNever) return std::nullopt;
  return impact;
}

std::optional<Impact> ofRectangles(const Body& first, const Body& second, const Vec2& w) {
  Impact impact{-kNever, Vec2::Zero()};
  double apartAgain = kNever;
  for (int axis = 0; axis < 2; ++axis) {
    const double low = second.position[axis] - (first.position[axis] + first.size[axis]);
    const double high = (second.position[axis] + second.size[axis]) - first.position[axis];
    const double speed = w[axis];
    const double touching = -kTouching * (first.size[axis] + second.size[axis]);
    // low ≥ 0: the second lies behind the first along this axis; high ≤ 0: before it.
    double enters = -kNever;
    double sign = 0.0;
    if (low >= touching && speed < 0.0) {
      enters = std::max(low, 0.0) / -speed;
      sign = 1.0;
    } else if (high <= -touching && speed > 0.0) {
      enters = std::max(-high, 0.0) / speed;
      sign = -1.0;
    } else if (low >= 0.0 || high <= 0.0) {
      return std::nullopt; // apart, and not getting nearer
    }
    if (speed > 0.0) apartAgain = std::min(apartAgain, -low / speed);
    if (speed < 0.0) apartAgain = std::min(apartAgain, high / -speed);
    if (!(enters > impact.time)) continue;
    impact.time = enters;
    impact.normal = Vec2::Zero();
    impact.normal[axis] = sign;
  }
  if (!(impact.time >= 0.0 && impact.time < apartAgain)) return std::nullopt;
  return impact;
}

std::optional<Impact> within(std::optional<Impact> impact, double most) {
  if (!impact || !(impact->time <= most)) return std::nullopt;
  return impact;
}

} // namespace

std::optional<Impact> timeOfImpact(const Body& first, const Vec2& v1, const Body& second, const Vec2& v2,
                                   double most) {
  const bool firstIsCircle = first.shape == Shape::Circle;
  const bool secondIsCircle = second.shape == Shape::Circle;
  const Vec2 w = v2 - v1;
  if (!(second.position - first.position).allFinite() || !w.allFinite()) return std::nullopt;
  if (firstIsCircle && secondIsCircle) return within(ofCircles(first, second, w), most);
  if (!firstIsCircle && !secondIsCircle) return within(ofRectangles(first, second, w), most);
  if (secondIsCircle) return within(ofRectangleAndCircle(first, second, w), most);
  std::optional<Impact> impact = within(ofRectangleAndCircle(second, first, -w), most);
  if (impact) impact->normal = -impact->normal;
  return impact;
}

} // namespace offstage
