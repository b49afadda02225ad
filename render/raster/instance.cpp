#include "render/raster/instance_parts.h"

#include <algorithm>
#include <cmath>

namespace offstage {
namespace {

/// A disc of this radius covers less than half of 1/255 of a pixel.
constexpr double kInvisibleRadius = 0.02;

/// Where saturating terms are cut off: far outside any canvas, small enough for exact float arithmetic.
constexpr double kFar = 1e6;

/// 1/px; a curvature of 0 says that there is no edge, and a float cannot hold that of the largest doubles.
constexpr double kLeastCurvature = 1e-30;

/// The pixel corner inside `clip` that is nearest to a point.
std::array<std::int16_t, 2> nearestPixelCorner(const Vec2& point, const PixelRect& clip) {
  const auto nearest = [](double value, int low, int high) {
    return static_cast<std::int16_t>(
        std::floor(std::clamp(value, static_cast<double>(low), static_cast<double>(high)) + 0.5));
  };
  return {nearest(point.x(), clip.left, clip.right), nearest(point.y(), clip.top, clip.bottom)};
}

/// |v| without overflow for the largest doubles.
double safeLength(const Vec2& v) {
  const double scale = std::max(std::abs(v.x()), std::abs(v.y()));
  return scale > 0.0 ? scale * length(v / scale) : 0.0;
}

std::array<float, 4> arcEdge(const Vec2& center, double radius) {
  return {static_cast<float>(center.x()), static_cast<float>(center.y()), static_cast<float>(radius * radius),
          0.0F};
}

std::array<float, 4> anyEdge(const Vec2& fromCenter, double radius) {
  const double distance = safeLength(fromCenter);
  const double c = 0.5 * (distance - radius) * (distance / radius + 1.0);
  return {static_cast<float>(fromCenter.x() / radius), static_cast<float>(fromCenter.y() / radius),
          static_cast<float>(std::max(1.0 / radius, kLeastCurvature)),
          static_cast<float>(std::clamp(c, -kFar, kFar))};
}

/// `least`: the inner radius, or the outer one again without a hole.
Coverage circleCoverage(double outer, double least, bool hole) {
  if (least < kLeastArcRadius) return Coverage::AnyCircle;
  if (outer > kMostArcRadius) return Coverage::LargeCircle;
  return hole ? Coverage::Ring : Coverage::Disc;
}

std::array<float, 4> boxEdges(const Vec2& low, const Vec2& high, const Vec2& origin) {
  const auto near = [](double value) { return static_cast<float>(std::clamp(value, -kFar, kFar)); };
  return {near(low.x() - origin.x()), near(low.y() - origin.y()), near(high.x() - origin.x()),
          near(high.y() - origin.y())};
}

void setCircle(const Primitive& primitive, const PixelRect& clip, Drawable& drawable) {
  Instance& instance = drawable.instance;
  instance.origin = nearestPixelCorner(primitive.center, clip);
  const Vec2 fromCenter = Vec2(instance.origin[0], instance.origin[1]) - primitive.center;
  const double inner = primitive.kind == Primitive::Kind::Ring ? primitive.inner : 0.0;
  const bool hole = inner >= kInvisibleRadius;
  drawable.coverage = circleCoverage(primitive.outer, hole ? inner : primitive.outer, hole);
  const bool arcs = drawable.coverage == Coverage::Disc || drawable.coverage == Coverage::Ring;
  const auto edge = [&](double radius) {
    return arcs ? arcEdge(primitive.center, radius) : anyEdge(fromCenter, radius);
  };
  instance.outer = edge(primitive.outer);
  if (hole) instance.inner = edge(inner);
}

void setBox(const Primitive& primitive, const PixelRect& bounds, Drawable& drawable) {
  Instance& instance = drawable.instance;
  const Vec2 corner(bounds.left, bounds.top);
  instance.origin = {static_cast<std::int16_t>(bounds.left), static_cast<std::int16_t>(bounds.top)};
  instance.outer = boxEdges(primitive.low, primitive.high, corner);
  const bool hole = primitive.kind == Primitive::Kind::BoxRing &&
                    primitive.innerLow.x() < primitive.innerHigh.x() &&
                    primitive.innerLow.y() < primitive.innerHigh.y();
  if (hole) instance.inner = boxEdges(primitive.innerLow, primitive.innerHigh, corner);
  drawable.coverage = Coverage::Box;
}

/// Bounds and mask stand on whole pixels, so the mask's corner is the origin.
void setMask(const Primitive& primitive, Drawable& drawable) {
  drawable.instance.origin = {static_cast<std::int16_t>(primitive.low.x()),
                              static_cast<std::int16_t>(primitive.low.y())};
  drawable.coverage = Coverage::Mask;
}

} // namespace

std::optional<Drawable> makeDrawable(const Primitive& primitive, const PixelRect& clip, int largestPoint) {
  using Kind = Primitive::Kind;
  const bool round = primitive.kind == Kind::Disc || primitive.kind == Kind::Ring;
  if (primitive.color.a == 0) return std::nullopt;
  if (primitive.kind >= Kind::Quad) return makePathDrawable(primitive, clip, largestPoint);
  if (round && !(primitive.outer >= kInvisibleRadius && std::isfinite(primitive.outer))) return std::nullopt;
  const Vec2 reach(primitive.outer, primitive.outer);
  const Vec2 low = round ? Vec2(primitive.center - reach) : primitive.low;
  const Vec2 high = round ? Vec2(primitive.center + reach) : primitive.high;
  const PixelRect bounds = touchedPixels(low, high, clip);
  if (bounds.empty()) return std::nullopt;

  Drawable drawable{};
  if (round) {
    setCircle(primitive, clip, drawable);
  } else if (primitive.kind == Kind::Mask) {
    setMask(primitive, drawable);
  } else {
    setBox(primitive, bounds, drawable);
  }
  finish(primitive, bounds, clip, largestPoint, drawable);
  return drawable;
}

} // namespace offstage
