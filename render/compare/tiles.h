#pragma once

#include "render/draw/picture.h"
#include "render/draw/pixel_rows.h"

#include <vector>

namespace offstage {

/// The parts of two pictures of equal size that a measure has to look at, whose value at a pixel depends on
/// the pixels up to `reach` columns and rows away: rectangles that cover all pixels with anything unequal
/// within reach. Everywhere else the pictures are equal as far as the measure can see.
std::vector<PixelRect> unequalTiles(const PixelRows& a, const PixelRows& b, int reach, int threads);

/// The largest tile, px.
constexpr int kTileWidth = 128;
constexpr int kTileHeight = 64;

} // namespace offstage
