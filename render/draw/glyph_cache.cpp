#include "render/draw/glyph_cache.h"

#include "render/draw/glyph_raster.h"
#include "src/sim/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr double kLargestMask = 8192.0; ///< px a side; keeps a damaged font from taking the memory

struct Box {
  double left = std::numeric_limits<double>::infinity();
  double top = std::numeric_limits<double>::infinity();
  double right = -std::numeric_limits<double>::infinity();
  double bottom = -std::numeric_limits<double>::infinity();
};

Box boxOf(const std::vector<Polygon>& polygons) {
  Box box;
  for (const Polygon& polygon : polygons) {
    for (const Vec2& corner : polygon) {
      box.left = std::min(box.left, corner.x());
      box.top = std::min(box.top, corner.y());
      box.right = std::max(box.right, corner.x());
      box.bottom = std::max(box.bottom, corner.y());
    }
  }
  return box;
}

GlyphMask rasterize(const GlyphKey& key, const GlyphOutline& outline) {
  GlyphPlacement placement;
  placement.scale = key.size / key.font->unitsPerEm();
  placement.pen = Vec2(key.phaseX, key.phaseY) / GlyphCache::kPhases;
  placement.upwards = key.upwards;
  std::vector<Polygon> polygons = flatten(outline, placement);
  const Box box = boxOf(polygons);
  if (!(box.left < box.right && box.top < box.bottom)) return {};
  const double margin = key.outline > 0.0 ? std::ceil(key.outline + 0.5) : 0.0;
  const Vec2 corner(std::floor(box.left) - margin, std::floor(box.top) - margin);
  const Vec2 size(std::ceil(box.right) + margin - corner.x(), std::ceil(box.bottom) + margin - corner.y());
  if (!(size.maxCoeff() <= kLargestMask && corner.cwiseAbs().maxCoeff() <= kLargestMask))
    throw Error(
        ExitCode::BadInput,
        fmt::format("a letter of {:.0f}x{:.0f} px cannot be drawn, {:.0f} px a side are the most: the text "
                    "is too large, or its font is damaged",
                    size.x(), size.y(), kLargestMask));
  for (Polygon& polygon : polygons) {
    for (Vec2& point : polygon) point -= corner;
  }
  Mask mask = fillPolygons(polygons, static_cast<int>(size.x()), static_cast<int>(size.y()));
  if (key.outline > 0.0) mask = outlinePolygons(polygons, mask, key.outline);
  return {std::make_shared<const Mask>(std::move(mask)), static_cast<int>(corner.x()),
          static_cast<int>(corner.y())};
}

} // namespace

const GlyphMask& GlyphCache::get(const GlyphKey& key) {
  const auto found = masks_.find(key);
  if (found != masks_.end()) return found->second;
  const auto [outline, isNew] = outlines_.try_emplace({key.font, key.glyph});
  if (isNew) outline->second = key.font->outline(key.glyph);
  return masks_.emplace(key, rasterize(key, outline->second)).first->second;
}

} // namespace offstage
