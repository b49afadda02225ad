#include "render/raster/instance.h"

#include <algorithm>
#include <cmath>

namespace offstage {
namespace {

/// A disc of this radius covers less than half of 1/255 of a pixel.
constexpr double kInvisibleRadius = 0.02;

/// Where saturating terms are cut off: far outside any canvas, small enough for exact float arithmetic.
constexpr double kFar = 1e6;

/// The pixels that low…high touches inside `clip`. Comparisons are written so that NaN gives none.
PixelRect touchedPixels(const Vec2& low, const Vec2& high, const PixelRect& clip) {
  if (!(low.x() < clip.right && low.y() < clip.bottom && high.x() > clip.left && high.y() > clip.top)) {
    return {};
  }
  const auto first = [](double value, int limit) {
    return static_cast<int>(std::floor(std::max(value, static_cast<double>(limit))));
  };
  const auto last = [](double value, int limit) {
    return static_cast<int>(std::ceil(std::min(value, static_cast<double>(limit))));
  };
  return {first(low.x(), clip.left), first(low.y(), clip.top), last(high.x(), clip.right),
          last(high.y(), clip.bottom)};
}

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

std::array<float, 4> circleEdge(const Vec2& fromCenter, double radius) {
  const double distance = safeLength(fromCenter);
  const double c = 0.5 * (distance - radius) * (distance / radius + 1.0);
  return {static_cast<float>(fromCenter.x() / radius), static_cast<float>(fromCenter.y() / radius),
          static_cast<float>(1.0 / radius), static_cast<float>(std::clamp(c, -kFar, kFar))};
}

std::array<float, 4> boxEdges(const Vec2& low, const Vec2& high, const Vec2& origin) {
  const auto near = [](double value) { return static_cast<float>(std::clamp(value, -kFar, kFar)); };
  return {near(low.x() - origin.x()), near(low.y() - origin.y()), near(high.x() - origin.x()),
          near(high.y() - origin.y())};
}

} // namespace

std::optional<Drawable> makeDrawable(const Primitive& primitive, const PixelRect& clip) {
  using Kind = Primitive::Kind;
  const bool round = primitive.kind == Kind::Disc || primitive.kind == Kind::Ring;
  const Vec2 reach(primitive.outer, primitive.outer);
  const Vec2 low = round ? Vec2(primitive.center - reach) : primitive.low;
  const Vec2 high = round ? Vec2(primitive.center + reach) : primitive.high;
  const PixelRect bounds = touchedPixels(low, high, clip);
  if (bounds.empty() || primitive.color.a == 0) return std::nullopt;

  Drawable drawable{};
  Instance& instance = drawable.instance;
  instance.quad = {static_cast<std::uint16_t>(bounds.left), static_cast<std::uint16_t>(bounds.top),
                   static_cast<std::uint16_t>(bounds.right), static_cast<std::uint16_t>(bounds.bottom)};
  instance.color = {primitive.color.r, primitive.color.g, primitive.color.b, primitive.color.a};
  if (round) {
    if (!(primitive.outer >= kInvisibleRadius) || !std::isfinite(primitive.outer)) return std::nullopt;
    const double inner = primitive.kind == Kind::Ring ? primitive.inner : 0.0;
    const bool hole = inner >= kInvisibleRadius;
    instance.origin = nearestPixelCorner(primitive.center, clip);
    const Vec2 fromCenter = Vec2(instance.origin[0], instance.origin[1]) - primitive.center;
    instance.outer = circleEdge(fromCenter, primitive.outer);
    if (hole) instance.inner = circleEdge(fromCenter, inner);
    const bool smallEdge = primitive.outer < kParabolaRadius || (hole && inner < kParabolaRadius);
    drawable.coverage = smallEdge ? Coverage::Small : hole ? Coverage::Ring : Coverage::Disc;
  } else {
    const Vec2 corner(bounds.left, bounds.top);
    instance.origin = {static_cast<std::int16_t>(bounds.left), static_cast<std::int16_t>(bounds.top)};
    instance.outer = boxEdges(primitive.low, primitive.high, corner);
    const bool hole = primitive.kind == Kind::BoxRing && primitive.innerLow.x() < primitive.innerHigh.x() &&
                      primitive.innerLow.y() < primitive.innerHigh.y();
    if (hole) instance.inner = boxEdges(primitive.innerLow, primitive.innerHigh, corner);
    drawable.coverage = Coverage::Box;
  }
  return drawable;
}

} // namespace offstage
