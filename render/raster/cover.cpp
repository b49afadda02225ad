#include "render/raster/cover.h"

#include <limits>

namespace offstage {
namespace {

/// px; a pixel that is farther than this from the exact edge gets exactly 0 or 1 from the shaders.
constexpr double kMargin = 0.0625;

/// From this radius on nothing is said of the inside: distances from the centre lose their fraction.
constexpr double kMostRadius = 1e6;

/// 0 for what is negative.
double squared(double radius) {
  return radius > 0.0 ? radius * radius : 0.0;
}

} // namespace

CoverTest::CoverTest(const Primitive& primitive)
    : round_(primitive.kind == Primitive::Kind::Disc || primitive.kind == Primitive::Kind::Ring) {
  if (!round_) {
    boxOutside_ = boundsOf(primitive.low, primitive.high, kMargin);
    boxInside_ = boundsOf(primitive.low, primitive.high, -kMargin);
    if (primitive.kind == Primitive::Kind::Mask) boxInside_ = nowhere();
    holed_ = primitive.kind == Primitive::Kind::BoxRing;
    if (holed_) {
      boxRim_ = boundsOf(primitive.innerLow, primitive.innerHigh, kMargin);
      boxHole_ = boundsOf(primitive.innerLow, primitive.innerHigh, -kMargin);
    }
    return;
  }
  x_ = primitive.center.x();
  y_ = primitive.center.y();
  if (!(primitive.outer < kMostRadius)) {
    outside_ = std::numeric_limits<double>::infinity();
    return;
  }
  outside_ = squared(primitive.outer + kMargin);
  inside_ = squared(primitive.outer - kMargin);
  if (primitive.kind == Primitive::Kind::Ring) {
    rim_ = squared(primitive.inner + kMargin);
    hole_ = squared(primitive.inner - kMargin);
  }
}

/// Holds no rectangle: what a mask covers wholly is not asked, for letters hardly cover a tile.
CoverTest::Bounds CoverTest::nowhere() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {kInfinity, kInfinity, -kInfinity, -kInfinity};
}

CoverTest::Bounds CoverTest::boundsOf(const Vec2& low, const Vec2& high, double grown) {
  return {low.x() - grown, low.y() - grown, high.x() + grown, high.y() + grown};
}

} // namespace offstage
