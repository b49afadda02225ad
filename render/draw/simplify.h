#pragma once

#include "src/sim/vec.h"

#include <vector>

namespace offstage {

/// Leaves points out of a path where it stays within `tolerance` of the rest, so that a smooth curve of
/// thousands of points takes a few dozen. Works from the first point on and looks back only as far as the
/// last point that it kept, so a curve that grows keeps its beginning. (Reumann and Witkam, Optimizing curve
/// segmentation in computer graphics, 1974, with a cone in place of the strip.)
class PathSimplifier {
public:
  /// `leastCosine`: of the angle by which the path may turn from one kept point to the next; by default any.
  explicit PathSimplifier(double tolerance, double leastCosine = -1.0)
      : tolerance_(tolerance), leastCosine_(leastCosine) {}

  void add(const Vec2& point);
  /// The points so far, the last one included.
  [[nodiscard]] std::vector<Vec2> path() const;
  void appendTo(std::vector<Vec2>& path) const; ///< the same behind what is there
  [[nodiscard]] bool empty() const { return kept_.empty(); }
  void clear();

private:
  void narrow(const Vec2& point);
  [[nodiscard]] bool turns(const Vec2& step) const; ///< too far from the direction in which the piece began

  double tolerance_;
  double leastCosine_;
  std::vector<Vec2> kept_;
  Vec2 last_ = Vec2::Zero();
  Vec2 first_ = Vec2::Zero(); ///< the step from kept_.back() to the point after it
  bool pending_ = false;      ///< last_ is behind kept_.back() and not kept
  // Directions from kept_.back() that pass all points since within the tolerance: between low_ and high_.
  Vec2 low_ = Vec2::Zero();
  Vec2 high_ = Vec2::Zero();
};

} // namespace offstage
