#include "render/raster/tile_set.h"

#include <algorithm>
#include <bit>

namespace offstage {
namespace {

/// The bounds of a cell's tiles in tiles, or an empty rectangle.
PixelRect tileBounds(std::uint64_t tiles) {
  if (tiles == 0) return {};
  std::uint64_t columns = tiles;
  for (const unsigned shift : {32U, 16U, 8U}) columns |= columns >> shift;
  const auto byte = static_cast<std::uint8_t>(columns);
  return {std::countr_zero(byte), std::countr_zero(tiles) / 8, 8 - std::countl_zero(byte),
          8 - std::countl_zero(tiles) / 8};
}

/// The tiles of a square of `side` tiles in a cell's upper-left corner.
constexpr std::uint64_t cornerSquare(unsigned side) {
  std::uint64_t square = 0;
  for (unsigned row = 0; row < side; ++row) square |= ((std::uint64_t{1} << side) - 1U) << (8U * row);
  return square;
}

void splitSquare(std::uint64_t tiles, unsigned x, unsigned y, unsigned side, const PixelRect& cell,
                 std::vector<PixelRect>& squares) {
  const std::uint64_t whole = side == 8 ? TileSet::kWhole : cornerSquare(side) << (8U * y + x);
  if ((tiles & whole) == 0) return;
  if ((tiles & whole) == whole) {
    const int left = cell.left + static_cast<int>(x) * TileSet::kTile;
    const int top = cell.top + static_cast<int>(y) * TileSet::kTile;
    const int length = static_cast<int>(side) * TileSet::kTile;
    squares.push_back({left, top, left + length, top + length});
    return;
  }
  const unsigned half = side / 2;
  splitSquare(tiles, x, y, half, cell, squares);
  splitSquare(tiles, x + half, y, half, cell, squares);
  splitSquare(tiles, x, y + half, half, cell, squares);
  splitSquare(tiles, x + half, y + half, half, cell, squares);
}

} // namespace

TileSet::TileSet(int width, int height)
    : width_(width),
      height_(height),
      columns_((width + kCell - 1) / kCell),
      rows_((height + kCell - 1) / kCell),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

void TileSet::clear() {
  std::fill(cells_.begin(), cells_.end(), 0);
}

bool TileSet::empty() const {
  return std::all_of(cells_.begin(), cells_.end(), [](std::uint64_t tiles) { return tiles == 0; });
}

void TileSet::appendRuns(std::vector<PixelRect>& runs) const {
  for (int row = 0; row < rows_; ++row) {
    bool open = false;
    for (int column = 0; column < columns_; ++column) {
      const PixelRect tiles = tileBounds(cell(column, row));
      if (tiles.empty()) {
        open = false;
        continue;
      }
      const PixelRect place = cellBounds(column, row);
      const PixelRect bounds{place.left + tiles.left * kTile, place.top + tiles.top * kTile,
                             std::min(place.left + tiles.right * kTile, width_),
                             std::min(place.top + tiles.bottom * kTile, height_)};
      if (open) {
        PixelRect& run = runs.back();
        run = {run.left, std::min(run.top, bounds.top), bounds.right, std::max(run.bottom, bounds.bottom)};
      } else {
        runs.push_back(bounds);
        open = true;
      }
    }
  }
}

void appendSquares(std::uint64_t tiles, int column, int row, std::vector<PixelRect>& squares) {
  splitSquare(tiles, 0, 0, 8, TileSet::cellBounds(column, row), squares);
}

} // namespace offstage
