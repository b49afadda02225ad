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

/// px: a straight piece of a path covers pixels whose centres lie between its cuts, so it reaches past its
/// ends.
constexpr double kBeyondCut = 0.75;

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
  const double outer = primitive.outer + kMargin;
  switch (primitive.kind) {
  case Kind::Quad:
    setEdges(primitive);
    break;
  case Kind::Arrow: {
    const Vec2 along = primitive.high - primitive.low;
    const double whole = length(along);
    const double head = whole > 0.0 ? std::min(primitive.innerLow.x() / whole, 1.0) : 1.0;
    const Vec2 neck = primitive.high - along * head;
    addBand(primitive.low, neck, outer, kMargin);
    addBand(neck, primitive.high, primitive.innerLow.y() + kMargin, kMargin);
    break;
  }
  case Kind::Strip:
    addBand(primitive.low, primitive.high, outer, outer + kBeyondCut);
    break;
  default:
    addBand(primitive.low, primitive.center, outer, outer);
    addBand(primitive.center, primitive.high, outer, outer);
  }
}

void CoverTest::addBand(const Vec2& from, const Vec2& to, double across, double past) {
  const Vec2 along = to - from;
  const double whole = length(along);
  // A band without length has no direction; a square one around the point holds it.
  const Vec2 ahead = whole > 0.0 ? Vec2(along / whole) : Vec2(1.0, 0.0);
  if (!(whole > 0.0)) across = past = std::max(across, past);
  bands_.at(bandCount_++) = {from, ahead, whole, across, past};
}

void CoverTest::setEdges(const Primitive& quad) {
  const std::array<Vec2, 4> corners{quad.low, quad.high, quad.innerLow, quad.innerHigh};
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
    edges_.at(edgeCount_++) = {normal, normal.dot(corners.at(i)) + kMargin};
  }
  boxOutside_ = boundsOf(corners[0].cwiseMin(corners[1]).cwiseMin(corners[2].cwiseMin(corners[3])),
                         corners[0].cwiseMax(corners[1]).cwiseMax(corners[2].cwiseMax(corners[3])), kMargin);
}

Cover CoverTest::ofPath(const PixelRect& rect) const {
  const Vec2 middle(0.5 * (rect.left + rect.right), 0.5 * (rect.top + rect.bottom));
  const Vec2 half(0.5 * (rect.right - rect.left), 0.5 * (rect.bottom - rect.top));
  for (std::size_t i = 0; i < bandCount_; ++i) {
    const Band& band = bands_.at(i);
    const Vec2 away = middle - band.from;
    const double x = std::abs(band.ahead.x());
    const double y = std::abs(band.ahead.y());
    const double along = band.ahead.dot(away);
    const double aside = std::abs(band.ahead.x() * away.y() - band.ahead.y() * away.x());
    const double past = band.past + x * half.x() + y * half.y();
    if (!(aside > band.across + y * half.x() + x * half.y() || along < -past || along > band.length + past))
      return Cover::Some;
  }
  if (bandCount_ > 0 || !boxOutside_.touches(rect)) return Cover::None;
  for (std::size_t i = 0; i < edgeCount_; ++i) {
    const Edge& edge = edges_.at(i);
    const double reach = std::abs(edge.normal.x()) * half.x() + std::abs(edge.normal.y()) * half.y();
    if (edge.normal.dot(middle) - reach > edge.offset) return Cover::None;
  }
  return Cover::Some;
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
