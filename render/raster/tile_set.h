#pragma once

#include "render/draw/picture.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace offstage {

/// The pixels that lie in both; empty() when there are none.
inline PixelRect common(const PixelRect& a, const PixelRect& b) {
  return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
          std::min(a.bottom, b.bottom)};
}

inline bool holds(const PixelRect& outer, const PixelRect& inner) {
  return common(outer, inner) == inner;
}

/// A set of the tiles of kTile×kTile px that a frame is divided into from its upper-left corner. Stored as
/// one word for each cell of 8×8 tiles: bit 8·row + column.
class TileSet {
public:
  static constexpr int kTile = 8;         ///< px
  static constexpr int kCell = 8 * kTile; ///< px
  static constexpr std::uint64_t kWhole = ~std::uint64_t{0};

  /// An empty set for a frame of this size in px.
  TileSet(int width, int height);

  [[nodiscard]] int columns() const { return columns_; } ///< cells
  [[nodiscard]] int rows() const { return rows_; }       ///< cells

  void clear();
  [[nodiscard]] std::uint64_t& cell(int column, int row) {
    return cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)];
  }
  [[nodiscard]] std::uint64_t cell(int column, int row) const {
    return cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)];
  }
  [[nodiscard]] static PixelRect cellBounds(int column, int row) {
    return {column * kCell, row * kCell, (column + 1) * kCell, (row + 1) * kCell};
  }
  /// The cells that a rectangle of the frame touches, as columns and rows.
  [[nodiscard]] static PixelRect cellsOf(const PixelRect& rect) {
    return {rect.left / kCell, rect.top / kCell, (rect.right + kCell - 1) / kCell,
            (rect.bottom + kCell - 1) / kCell};
  }

  /// Adds the tile that holds a pixel of the frame.
  void addTile(int x, int y) {
    cell(x / kCell, y / kCell) |= std::uint64_t{1}
                                  << static_cast<unsigned>(y % kCell / kTile * 8 + x % kCell / kTile);
  }
  [[nodiscard]] bool empty() const;

  /// The bounds of the tiles in each run of neighbouring cells that have some, cut to the frame: disjoint.
  void appendRuns(std::vector<PixelRect>& runs) const;

private:
  int width_;
  int height_;
  int columns_;
  int rows_;
  std::vector<std::uint64_t> cells_;
};

/// The largest squares of 64, 32, 16 and 8 px, each at a multiple of its side, that a cell's tiles are made
/// up of, appended with the cell's place added.
void appendSquares(std::uint64_t tiles, int column, int row, std::vector<PixelRect>& squares);

} // namespace offstage
