// Polygons and pieces of paths made ready for GL; instance.cpp has circles and boxes.
#include "render/raster/instance_parts.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace offstage {
namespace {

using Kind = Primitive::Kind;

/// px: a path's pieces end where a pixel's centre crosses a cut, so the pixel reaches farther by half its
/// diagonal.
constexpr double kHalfDiagonal = 0.75;

/// px: farther out, floats have no fraction left that would place an edge.
constexpr double kFarthest = 65536.0;

/// px; half the width of a line that covers less than half of 1/255 of a pixel.
constexpr double kInvisibleHalfWidth = 0.001;

struct Box2 {
  Vec2 low, high;

  explicit Box2(std::span<const Vec2> points) : low(points[0]), high(points[0]) {
    for (const Vec2& point : points.subspan(1)) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  }
  [[nodiscard]] bool usable() const { // false for NaN, too
    return low.x() > -kFarthest && low.y() > -kFarthest && high.x() < kFarthest && high.y() < kFarthest;
  }
};

std::array<float, 2> fromOrigin(const Vec2& point, const Instance& instance) {
  return {static_cast<float>(point.x() - instance.origin[0]),
          static_cast<float>(point.y() - instance.origin[1])};
}

void setOrigin(const PixelRect& bounds, Instance& instance) {
  instance.origin = {static_cast<std::int16_t>(bounds.left), static_cast<std::int16_t>(bounds.top)};
}

/// Writes up to seven corners: two in outer, two in inner, two in texelMap, one in window.
void setCorners(std::span<const Vec2> corners, Instance& instance) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::array<float, 2> at = fromOrigin(corners[i], instance);
    float* place = i < 2   ? &instance.outer[2 * i]
                   : i < 4 ? &instance.inner[2 * i - 4]
                   : i < 6 ? &instance.texelMap[2 * i - 8]
                           : instance.window.data();
    place[0] = at[0];
    place[1] = at[1];
  }
}

/// The tail's two corners, the head's base and its tip.
std::array<Vec2, 7> arrowCorners(const Primitive& arrow) {
  const Vec2 along = arrow.high - arrow.low;
  const double whole = length(along);
  const Vec2 ahead = whole > 0.0 ? Vec2(along / whole) : Vec2(1.0, 0.0);
  const Vec2 aside(-ahead.y(), ahead.x());
  const Vec2 neck = arrow.high - ahead * std::min(arrow.innerLow.x(), whole);
  const Vec2 shaft = aside * arrow.outer;
  const Vec2 head = aside * arrow.innerLow.y();
  return {arrow.low - shaft, neck - shaft, neck - head,      arrow.high,
          neck + head,       neck + shaft, arrow.low + shaft};
}

/// A cut as the shader tests it; the same floats in both pieces that meet there.
std::array<float, 3> cutAt(const Vec2& point, const Vec2& normal) {
  return {static_cast<float>(normal.x()), static_cast<float>(normal.y()),
          static_cast<float>(-(normal.x() * point.x() + normal.y() * point.y()))};
}

void setCuts(const Primitive& piece, Instance& instance) {
  const bool first = piece.innerLow != Vec2::Zero();
  const bool second = piece.innerHigh != Vec2::Zero();
  // Without a cut every pixel is in front of the first and none in front of the second.
  const std::array<float, 3> low = first ? cutAt(piece.low, piece.innerLow) : std::array{0.0F, 0.0F, 1.0F};
  const std::array<float, 3> high =
      second ? cutAt(piece.high, piece.innerHigh) : std::array{0.0F, 0.0F, -1.0F};
  instance.texelMap = {low[0], low[1], low[2], high[0]};
  instance.window = {high[1], high[2]};
}

void setStrip(const Primitive& strip, Instance& instance) {
  const Vec2 along = strip.high - strip.low;
  const Vec2 ahead = along / length(along);
  const Vec2 normal(-ahead.y(), ahead.x());
  const double offset = -(normal.x() * strip.low.x() + normal.y() * strip.low.y());
  instance.outer = {static_cast<float>(normal.x()), static_cast<float>(normal.y()),
                    static_cast<float>(offset), static_cast<float>(strip.outer)};
  setCuts(strip, instance);
}

/// How steeply a straight line crosses columns: 0 along the axis, 1 at right angles to it.
double steepness(const Vec2& along, int axis) {
  const double whole = length(along);
  return whole > 0.0 ? std::abs(along[1 - axis]) / whole : 0.0;
}

void setElbow(const Primitive& elbow, Instance& instance) {
  const Vec2 first = elbow.center - elbow.low;
  const Vec2 second = elbow.high - elbow.center;
  // The shader sums up columns, which is the more exact the less steeply the arms cross them.
  const bool exchanged = std::max(steepness(first, 1), steepness(second, 1)) <
                         std::max(steepness(first, 0), steepness(second, 0));
  const auto place = [&](const Vec2& point) {
    std::array<float, 2> at = fromOrigin(point, instance);
    if (exchanged) std::swap(at[0], at[1]);
    return at;
  };
  const auto from = place(elbow.low);
  const auto corner = place(elbow.center);
  const auto to = place(elbow.high);
  instance.outer = {from[0], from[1], corner[0], corner[1]};
  instance.inner = {to[0], to[1], static_cast<float>(elbow.outer), exchanged ? 1.0F : 0.0F};
  setCuts(elbow, instance);
}

std::optional<Drawable> makePolygon(const Primitive& primitive, std::span<const Vec2> corners,
                                    Coverage coverage, const PixelRect& clip, int largestPoint) {
  const Box2 box(corners);
  if (!box.usable()) return std::nullopt;
  const PixelRect bounds = touchedPixels(box.low, box.high, clip);
  if (bounds.empty()) return std::nullopt;
  Drawable drawable{.instance = {}, .coverage = coverage, .footprint = Footprint::Quad};
  setOrigin(bounds, drawable.instance);
  setCorners(corners, drawable.instance);
  finish(primitive, bounds, clip, largestPoint, drawable);
  return drawable;
}

std::optional<Drawable> makePiece(const Primitive& piece, const PixelRect& clip, int largestPoint) {
  const bool straight = piece.kind == Kind::Strip;
  if (!(piece.outer >= kInvisibleHalfWidth && piece.outer < kFarthest)) return std::nullopt;
  const std::array<Vec2, 3> points{piece.low, straight ? piece.high : piece.center, piece.high};
  const Box2 box(points);
  if (!box.usable() || (straight && piece.low == piece.high)) return std::nullopt;
  const Vec2 reach = Vec2::Constant(piece.outer + kHalfDiagonal);
  const PixelRect bounds = touchedPixels(box.low - reach, box.high + reach, clip);
  if (bounds.empty()) return std::nullopt;
  Drawable drawable{
      .instance = {}, .coverage = straight ? Coverage::Strip : Coverage::Elbow, .footprint = Footprint::Quad};
  setOrigin(bounds, drawable.instance);
  if (straight) {
    setStrip(piece, drawable.instance);
  } else {
    setElbow(piece, drawable.instance);
  }
  finish(piece, bounds, clip, largestPoint, drawable);
  return drawable;
}

} // namespace

std::optional<Drawable> makePathDrawable(const Primitive& primitive, const PixelRect& clip,
                                         int largestPoint) {
  switch (primitive.kind) {
  case Kind::Quad: {
    const std::array<Vec2, 4> corners{primitive.low, primitive.high, primitive.innerLow, primitive.innerHigh};
    return makePolygon(primitive, corners, Coverage::Quad, clip, largestPoint);
  }
  case Kind::Arrow:
    return makePolygon(primitive, arrowCorners(primitive), Coverage::Arrow, clip, largestPoint);
  default:
    return makePiece(primitive, clip, largestPoint);
  }
}

} // namespace offstage
