#pragma once

#include "render/compare/tiles.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace offstage {

// The inner parts of FLIP, for one tile of one picture. Formulas: the paper named in flip.h.

/// Pixels around a tile that its filters reach: three standard deviations of the widest.
constexpr int kFlipReach = 10;
/// Floats of a row of a tile with what is around it.
constexpr std::size_t kFlipStride = kTileWidth + 2 * kFlipReach;
constexpr std::size_t kFlipRows = kTileHeight + 2 * kFlipReach;

/// A tile and what is around it, in the opponent space YCxCz.
struct FlipPlanes {
  using Plane = std::array<float, kFlipStride * kFlipRows>;
  Plane y, cx, cz;
};

/// What an eye makes of a tile's pixels.
struct FlipResponse {
  using Plane = std::array<float, static_cast<std::size_t>(kTileWidth) * kTileHeight>;
  Plane lightness, red, blue; ///< L*, a*, b* after the filters, a* and b* by Hunt's effect
  Plane edge, point;          ///< strengths of edges and of points
};

/// An sRGB colour in YCxCz.
void toYCxCz(const std::uint8_t* rgb, float& y, float& cx, float& cz);

/// Rows of a tile and what is around it after the filters along x.
struct FlipScratch {
  using Plane = std::array<float, static_cast<std::size_t>(kTileWidth) * kFlipRows>;
  Plane y, cx, cz1, cz2, gauss, slope, curve;
};

/// Filters the first `rows` rows of a tile, of its whole width.
void filterTile(const FlipPlanes& planes, int rows, FlipScratch& scratch, FlipResponse& response);

/// The errors of one row of a tile.
void flipErrors(const FlipResponse& reference, const FlipResponse& test, int row, int columns, float* errors);

} // namespace offstage
