#include "render/raster/cover.h"

#include <cmath>
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

/// px: a piece of a path covers pixels whose centres lie between its cuts, so it reaches past its ends.
constexpr double kBeyondCut = 0.75;

double squaredDistance(const Vec2& point, const Vec2& from, const Vec2& to) {
  const Vec2 along = to - from;
  const double whole = along.squaredNorm();
  const double part = whole > 0.0 ? std::clamp((point - from).dot(along) / whole, 0.0, 1.0) : 0.0;
  return (from + along * part - point).squaredNorm();
}

/// Whether a line along an edge of a convex quadrilateral has it on one side and the rectangle on the other.
bool separates(const std::array<Vec2, 4>& corners, const Vec2& middle, const Vec2& half) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 along = corners.at((i + 1) % 4) - corners.at(i);
    const double whole = length(along);
    if (!(whole > 0.0)) continue;
    Vec2 normal(-along.y() / whole, along.x() / whole);
    double most = 0.0; // of the corners' distances: on which side the quadrilateral lies
    for (const Vec2& corner : corners) {
      const double distance = normal.dot(corner - corners.at(i));
      if (std::abs(distance) > std::abs(most)) most = distance;
    }
    if (most > 0.0) normal = -normal;
    const double reach = std::abs(normal.x()) * half.x() + std::abs(normal.y()) * half.y();
    if (normal.dot(middle - corners.at(i)) - reach > kMargin) return true;
  }
  const Vec2 low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2].cwiseMin(corners[3]));
  const Vec2 high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2].cwiseMax(corners[3]));
  const Vec2 grown = half + Vec2::Constant(kMargin);
  return middle.x() + grown.x() < low.x() || middle.x() - grown.x() > high.x() ||
         middle.y() + grown.y() < low.y() || middle.y() - grown.y() > high.y();
}

} // namespace

CoverTest::CoverTest(const Primitive& primitive) {
  using Kind = Primitive::Kind;
  if (primitive.kind >= Kind::Quad) {
    outline_ = Outline::Path;
    setPath(primitive);
    return;
  }
  if (primitive.kind == Kind::Disc || primitive.kind == Kind::Ring) outline_ = Outline::Circle;
  if (outline_ == Outline::Box) {
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

void CoverTest::setPath(const Primitive& primitive) {
  using Kind = Primitive::Kind;
  switch (primitive.kind) {
  case Kind::Quad:
    points_ = {primitive.low, primitive.high, primitive.innerLow, primitive.innerHigh};
    break;
  case Kind::Arrow:
    points_ = {primitive.low, primitive.high};
    arms_ = 1;
    reach_ = std::max(primitive.outer, primitive.innerLow.y());
    break;
  case Kind::Strip:
    points_ = {primitive.low, primitive.high};
    arms_ = 1;
    reach_ = primitive.outer + kBeyondCut;
    break;
  default:
    points_ = {primitive.low, primitive.center, primitive.high};
    arms_ = 2;
    reach_ = primitive.outer + kBeyondCut;
  }
}

Cover CoverTest::ofPath(const PixelRect& rect) const {
  const Vec2 middle(0.5 * (rect.left + rect.right), 0.5 * (rect.top + rect.bottom));
  const Vec2 half(0.5 * (rect.right - rect.left), 0.5 * (rect.bottom - rect.top));
  if (arms_ == 0) return separates(points_, middle, half) ? Cover::None : Cover::Some;
  const double farthest = reach_ + kMargin + length(half);
  for (std::size_t i = 0; i < arms_; ++i) {
    if (!(squaredDistance(middle, points_.at(i), points_.at(i + 1)) > farthest * farthest))
      return Cover::Some;
  }
  return Cover::None;
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
