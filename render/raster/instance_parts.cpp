#include "render/raster/instance_parts.h"

#include <algorithm>
#include <cmath>

namespace offstage {
namespace {

/// px: shading so many more than needed costs less than what a point saves over a quad.
constexpr int kSparePixels = 150;

/// The bounds, made square where a point can draw them and that is cheaper. What is added lies inside the
/// clip and outside the shape: a circle's bounds differ by at most one pixel in width and height.
Footprint chooseFootprint(PixelRect& bounds, const PixelRect& clip, int largestPoint) {
  const int width = bounds.right - bounds.left;
  const int height = bounds.bottom - bounds.top;
  const int side = std::max(width, height);
  const PixelRect square{bounds.left, bounds.top, bounds.left + side, bounds.top + side};
  const bool cheap = std::min(width, height) >= side - 1 || side * side - width * height <= kSparePixels;
  if (!cheap || side > largestPoint || square.right > clip.right || square.bottom > clip.bottom) {
    return Footprint::Quad;
  }
  bounds = square;
  return Footprint::Point;
}

} // namespace

PixelRect touchedPixels(const Vec2& low, const Vec2& high, const PixelRect& clip) {
  if (!(low.x() < clip.right && low.y() < clip.bottom && high.x() > clip.left && high.y() > clip.top)) {
    return {}; // also for NaN
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

void finish(const Primitive& primitive, const PixelRect& bounds, const PixelRect& clip, int largestPoint,
            Drawable& drawable) {
  PixelRect shaded = bounds;
  drawable.footprint = chooseFootprint(shaded, clip, largestPoint);
  Instance& instance = drawable.instance;
  instance.quad = {static_cast<std::uint16_t>(shaded.left), static_cast<std::uint16_t>(shaded.top),
                   static_cast<std::uint16_t>(shaded.right), static_cast<std::uint16_t>(shaded.bottom)};
  instance.color = {primitive.color.r, primitive.color.g, primitive.color.b, primitive.color.a};
}

} // namespace offstage
