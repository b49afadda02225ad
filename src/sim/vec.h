#pragma once

#include <cmath>

#include <Eigen/Core>

namespace offstage {

/// A 2D vector of IEEE doubles: a position in pixels (y points down), a velocity in px/s, or an acceleration
/// in px/s².
using Vec2 = Eigen::Vector2d;

/// a·b as (a.x*b.x) + (a.y*b.y): two products, one sum, in this order, because the result is held to a JVM's
/// bits.
inline double dot(const Vec2& a, const Vec2& b) {
  return a.x() * b.x() + a.y() * b.y();
}

/// |a| as sqrt(a.x*a.x + a.y*a.y). IEEE 754 requires sqrt to be correctly rounded, so this is the same
/// everywhere.
inline double length(const Vec2& a) {
  return std::sqrt(a.x() * a.x() + a.y() * a.y());
}

} // namespace offstage
