#pragma once

#include "src/sim/body.h"
#include "src/sim/vec.h"

#include <optional>

namespace offstage {

/// When, and along which direction, two moving bodies begin to touch.
struct Impact {
  double time = 0.0;          ///< s, from now
  Vec2 normal = Vec2::Zero(); ///< of length 1, from the first body to the second
};

/// The first moment, from 0 to `within` (s), at which two bodies that move at the constant velocities v1 and
/// v2 (px/s) begin to touch, by closed forms: no stepping, so the time is right to rounding.
///
///   circle, circle        |d + w·t| = r1 + r2 with d = c2 − c1, w = v2 − v1: the smaller root of
///                         (w·w)t² + 2(d·w)t + (d·d − (r1 + r2)²) = 0, in the form that does not cancel
///   circle, rectangle     the circle's centre meets the rectangle grown by r: its sides, or the quarter
///                         circles around its corners
///   rectangle, rectangle  the last of the two moments at which their extents along x and along y begin to
///                         overlap
///
/// None when they do not meet within that time, when they only graze (no closing speed), or when they
/// overlap already: that is for findContact() to deal with. Source: C. Ericson, Real-Time Collision
/// Detection, sections 5.5.5 (spheres), 5.5.7 (sphere and box) and 5.5.8 (boxes).
std::optional<Impact> timeOfImpact(const Body& first, const Vec2& v1, const Body& second, const Vec2& v2,
                                   double within);

} // namespace offstage
