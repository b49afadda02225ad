#include "render/raster/tile_order.h"

#include <algorithm>
#include <numeric>

namespace offstage {
namespace {

std::size_t count(int length, int side) {
  return static_cast<std::size_t>((length + side - 1) / side);
}

} // namespace

TileOrder::TileOrder(int width, int height)
    : tileColumns_(static_cast<int>(count(width, kTile))),
      cellColumns_(static_cast<int>(count(width, kCell))),
      tiles_(count(width, kTile) * count(height, kTile)),
      cells_(count(width, kCell) * count(height, kCell)) {}

std::span<const std::uint32_t> TileOrder::sorted(std::span<const std::uint32_t> members,
                                                 const std::vector<Instance>& instances) {
  if (members.size() < kLargeBatch) return members;
  last_.assign(cells_, 0);
  begins_.assign(tiles_ + 1, 0);
  with_.clear();
  for (const std::uint32_t member : members) {
    with_.push_back(place(instances[member]));
    ++begins_[with_.back() + 1];
  }
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  sorted_.resize(members.size());
  for (std::size_t i = 0; i < members.size(); ++i) sorted_[begins_[with_[i]]++] = members[i];
  return sorted_;
}

/// The tile that an instance is drawn with: its own, or a later one where it overlaps what is drawn with that
/// one and comes after it.
std::uint32_t TileOrder::place(const Instance& instance) {
  std::uint32_t tile = tileOf(instance);
  visitCells(instance, [&](std::uint32_t& last) { tile = std::max(tile, last); });
  visitCells(instance, [&](std::uint32_t& last) { last = tile; });
  return tile;
}

/// Of its upper-left corner. Tiles are numbered as llvmpipe shades them, row by row.
std::uint32_t TileOrder::tileOf(const Instance& instance) const {
  return static_cast<std::uint32_t>(instance.quad[1] / kTile * tileColumns_ + instance.quad[0] / kTile);
}

template <typename Visit>
void TileOrder::visitCells(const Instance& instance, Visit visit) {
  const int left = instance.quad[0] / kCell;
  const int right = (instance.quad[2] + kCell - 1) / kCell;
  const int bottom = (instance.quad[3] + kCell - 1) / kCell;
  for (int row = instance.quad[1] / kCell; row < bottom; ++row) {
    const std::size_t line = static_cast<std::size_t>(row) * static_cast<std::size_t>(cellColumns_);
    for (int column = left; column < right; ++column) visit(last_[line + static_cast<std::size_t>(column)]);
  }
}

} // namespace offstage
