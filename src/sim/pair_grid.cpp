#include "src/sim/pair_grid.h"

#include <algorithm>
#include <bit>

namespace offstage {

void PairGrid::layOut(std::span<const Body> bodies, std::span<const std::uint8_t> paired, double margin) {
  sizes_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (paired[i] != 0) sizes_.count(extentOf(bodies[i]));
  }
  sizes_.layOut();
  const auto unbounded = static_cast<std::uint32_t>(sizes_.members().size());
  level_.resize(bodies.size());
  levels_.assign(unbounded, Level{});
  // The largest extent of each level, kept in cellsPerPixel until all are known.
  for (Level& level : levels_) level.cellsPerPixel = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double extent = extentOf(bodies[i]);
    const std::uint32_t level = paired[i] != 0 ? sizes_.levelOf(extent) : 0;
    level_[i] = static_cast<std::uint8_t>(paired[i] == 0 ? unbounded + 1 : std::min(level, unbounded));
    if (level_[i] < unbounded) levels_[level].cellsPerPixel = std::max(levels_[level].cellsPerPixel, extent);
  }
  std::uint32_t lists = 0;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    Level& level = levels_[i];
    // A little wider than needed, for the roundings of whoever asks how far two bodies are apart.
    const double side = level.cellsPerPixel * ((1.0 + 0.5 * margin) * 1.000001);
    level.cellsPerPixel = side > 0.0 ? 1.0 / side : 1.0;
    level.firstList = lists;
    level.mask = std::max(32U, std::bit_ceil(sizes_.members()[i])) - 1;
    lists += level.mask + 1;
  }
  starts_.resize(lists + 3);
  list_.resize(bodies.size());
  order_.resize(bodies.size());
  findColumns(bodies);
}

void PairGrid::findColumns(std::span<const Body> bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Point centre = centreOf(bodies[i]);
    if (level_[i] < levels_.size() && bothFinite(load(&centre.x))) {
      Level& level = levels_[level_[i]];
      level.note(cellAt(level, centre).x);
    }
  }
}

/// A row of lists for each row of cells, as wide as the bodies are spread. Where that is too wide for the
/// lists that there are, an odd part of them (2^32 over the golden ratio; Knuth, The Art of Computer
/// Programming, volume 3, section 6.4). Bodies that have spread since the step before only share lists with
/// others.
void PairGrid::chooseStride(Level& level) {
  constexpr std::uint32_t kSpread = 2654435769U;
  const std::uint32_t columns = level.rightmost - level.leftmost;
  const bool fits = level.leftmost <= level.rightmost && columns < level.mask / 4;
  level.stride = fits ? columns + 3 : kSpread;
  level.leftmost = 0xffffffffU;
  level.rightmost = 0;
}

PairGrid::Counting::Counting(PairGrid& grid)
    : levels_(grid.levels_.data()),
      levelCount_(grid.levels_.size()),
      numbers_(grid.level_.data()),
      lists_(grid.list_.data()),
      starts_(grid.starts_.data()),
      unbounded_(static_cast<std::uint32_t>(grid.starts_.size() - 3)) {}

PairGrid::Counting PairGrid::startCounting() {
  for (Level& level : levels_) chooseStride(level);
  std::fill(starts_.begin(), starts_.end(), 0U);
  return Counting(*this);
}

void PairGrid::startInserting() {
  for (std::size_t list = 1; list < starts_.size(); ++list) starts_[list] += starts_[list - 1];
  firstUnbounded_ = starts_[starts_.size() - 3];
  firstAlone_ = starts_[starts_.size() - 2];
}

void PairGrid::end() {
  // insert() has moved each start to its list's end, which is the next one's start.
  std::copy_backward(starts_.begin(), starts_.end() - 1, starts_.end());
  starts_[0] = 0;
}

} // namespace offstage
