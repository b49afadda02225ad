#pragma once

#include "src/sim/force.h"
#include "src/sim/vec.h"
#include "src/sim/world_setup.h"

#include <optional>

namespace offstage {

/// value ↦ offset + scale·value.
struct AffineMap {
  double scale = 1.0;
  double offset = 0.0;

  [[nodiscard]] bool isIdentity() const { return scale == 1.0 && offset == 0.0; }
  /// The identity returns the very bits that it was given; 0.0 + 1.0·(−0.0) would not.
  [[nodiscard]] double operator()(double value) const {
    return isIdentity() ? value : offset + scale * value;
  }
};

/// `[view]`: the scene's own units and axes mapped onto the simulation's pixels, y down. Everything is mapped
/// once, while the scene is read; the simulation only knows pixels. Without a [view] every map is the
/// identity.
class View {
public:
  View() = default;
  /// `pixelsPerUnit` > 0; `origin`: the pixel at which the scene's (0, 0) lies; `yUp`: the scene's y points
  /// up.
  View(double pixelsPerUnit, const Vec2& origin, bool yUp);

  [[nodiscard]] bool isIdentity() const { return x().isIdentity() && y().isIdentity(); }

  [[nodiscard]] AffineMap x() const { return {scale_, origin_.x()}; } ///< of a position
  [[nodiscard]] AffineMap y() const { return {yScale_, origin_.y()}; }
  [[nodiscard]] AffineMap vectorX() const {
    return {scale_, 0.0};
  } ///< of a velocity, an acceleration, a force
  [[nodiscard]] AffineMap vectorY() const { return {yScale_, 0.0}; }
  [[nodiscard]] AffineMap length() const { return {scale_, 0.0}; }

  [[nodiscard]] Vec2 position(const Vec2& p) const { return {x()(p.x()), y()(p.y())}; }
  [[nodiscard]] Vec2 vector(const Vec2& v) const { return {vectorX()(v.x()), vectorY()(v.y())}; }
  [[nodiscard]] Vec2 size(const Vec2& s) const { return {length()(s.x()), length()(s.y())}; }
  /// G·M, length³/s².
  [[nodiscard]] double attraction(double strength) const;
  /// mass/length.
  [[nodiscard]] double perLength(double value) const;
  /// A state of the simulation in the scene's units, as an expression sees it.
  [[nodiscard]] ForceState toScene(const ForceState& state) const;

private:
  double scale_ = 1.0;
  double yScale_ = 1.0; ///< scale_, negative where the scene's y points up
  Vec2 origin_ = Vec2::Zero();
};

/// A spawner's number after the map. Nothing for an IntegerNumber under any map but the identity: it draws
/// whole pixels, as the lecture does, and has no affine form.
std::optional<Number> mapped(const Number& number, const AffineMap& map);

} // namespace offstage
