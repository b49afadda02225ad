#pragma once

#include "render/draw/font.h"
#include "render/draw/mask.h"
#include "src/sim/vec.h"

#include <vector>

namespace offstage {

/// A closed contour as its corners, px, y down.
using Polygon = std::vector<Vec2>;

/// From font units to pixels.
struct GlyphPlacement {
  double scale = 1.0;   ///< px a font unit
  Vec2 pen{0.0, 0.0};   ///< px
  bool upwards = false; ///< turned a quarter counterclockwise about the pen
};

/// The outline as polygons: curves are cut into chords that are off by at most 1/100 px.
std::vector<Polygon> flatten(const GlyphOutline& outline, const GlyphPlacement& placement);

/// The part of every pixel that polygons cover, the exact area rounded to 1/255; what several contours with
/// the same sense cover counts once, and holes go the other way round, as both font formats have it. The
/// polygons must lie inside 0 … width, 0 … height.
///
/// For each edge every pixel keeps the height that the edge spans there and the area between the edge and the
/// pixel's left side; summed from the left, these give the covered area (signed-area accumulation; the idea
/// is FreeType's smooth rasterizer's). Doubles and nothing but + − × / and floor: the same bytes everywhere.
Mask fillPolygons(const std::vector<Polygon>& polygons, int width, int height);

/// A pen of radius `reach` (px) drawn along the polygons, united with `fill`: an outline around letters. A
/// pixel counts by the distance d of its centre from the nearest edge: reach + 1/2 − d, held to 0 … 1.
Mask outlinePolygons(const std::vector<Polygon>& polygons, const Mask& fill, double reach);

} // namespace offstage
