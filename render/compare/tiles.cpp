#include "render/compare/tiles.h"

#include "render/compare/parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace offstage {
namespace {

constexpr int kBlock = 16; // px a side: how finely it is known where the pictures differ

/// Which blocks hold an unequal pixel.
class Blocks {
public:
  Blocks(const PixelRows& a, const PixelRows& b, int threads)
      : columns_((a.width() + kBlock - 1) / kBlock),
        rows_((a.height() + kBlock - 1) / kBlock),
        unequal_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0) {
    parallelFor(rows_, 4, threads, [&](int, int begin, int end) {
      for (int row = begin; row < end; ++row) mark(a, b, row);
    });
  }

  [[nodiscard]] bool anyIn(const PixelRect& rect) const {
    const int left = std::max(0, rect.left) / kBlock;
    const int right = std::min(columns_, (rect.right + kBlock - 1) / kBlock);
    const int bottom = std::min(rows_, (rect.bottom + kBlock - 1) / kBlock);
    for (int row = std::max(0, rect.top) / kBlock; row < bottom; ++row) {
      const std::uint8_t* blocks = &unequal_[index(row, 0)];
      if (std::any_of(blocks + left, blocks + right, [](std::uint8_t block) { return block != 0; }))
        return true;
    }
    return false;
  }

private:
  [[nodiscard]] std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  void mark(const PixelRows& a, const PixelRows& b, int row) {
    const bool alike = a.layout() == b.layout();
    const std::size_t bytes = 4UL * static_cast<std::size_t>(a.width()) * (a.deep() || b.deep() ? 2 : 1);
    std::vector<std::uint8_t> bufferA(bytes);
    std::vector<std::uint8_t> bufferB(bytes);
    for (int y = row * kBlock; y < std::min(a.height(), (row + 1) * kBlock); ++y) {
      const auto stored = a.stored(y);
      if (alike && std::memcmp(stored.data(), b.stored(y).data(), stored.size()) == 0) continue;
      const std::uint8_t* rowA = bufferA.data();
      const std::uint8_t* rowB = bufferB.data();
      if (a.deep() || b.deep()) {
        a.row16(y, reinterpret_cast<std::uint16_t*>(bufferA.data()));
        b.row16(y, reinterpret_cast<std::uint16_t*>(bufferB.data()));
      } else {
        rowA = a.row8(y, bufferA.data());
        rowB = b.row8(y, bufferB.data());
      }
      const std::size_t step = bytes / static_cast<std::size_t>(a.width()) * kBlock;
      for (int column = 0; column < columns_; ++column) {
        const std::size_t from = static_cast<std::size_t>(column) * step;
        if (std::memcmp(rowA + from, rowB + from, std::min(step, bytes - from)) != 0)
          unequal_[index(row, column)] = 1;
      }
    }
  }

  int columns_;
  int rows_;
  std::vector<std::uint8_t> unequal_;
};

} // namespace

std::vector<PixelRect> unequalTiles(const PixelRows& a, const PixelRows& b, int reach, int threads) {
  const Blocks blocks(a, b, threads);
  std::vector<PixelRect> tiles;
  for (int top = 0; top < a.height(); top += kTileHeight) {
    for (int left = 0; left < a.width(); left += kTileWidth) {
      const PixelRect tile{left, top, std::min(a.width(), left + kTileWidth),
                           std::min(a.height(), top + kTileHeight)};
      if (blocks.anyIn({tile.left - reach, tile.top - reach, tile.right + reach, tile.bottom + reach}))
        tiles.push_back(tile);
    }
  }
  return tiles;
}

} // namespace offstage
