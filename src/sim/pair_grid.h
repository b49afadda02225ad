#pragma once

#include "src/sim/body.h"
#include "src/sim/size_levels.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// All pairs of bodies that are near each other, found with a grid of several levels that is filled by
/// counting and so keeps its bodies side by side in memory. A body lies in the cell of its centre; the cells
/// of a level are as wide as its largest body and the margin around it. Bodies get slots 0, 1, 2, … in the
/// grid's order, in which neighbours in the pane are mostly neighbours in memory: the order is the bodies'
/// alone, the same on every machine.
class PairGrid {
public:
  struct Point {
    double x, y; ///< px
  };
  static Point centreOf(const Body& body) {
    if (body.shape == Shape::Circle) return {body.position.x(), body.position.y()};
    const Vec2 centre = body.position + body.size * 0.5;
    return {centre.x(), centre.y()};
  }

  /// Counts what every cell will hold. `margin`: two bodies are near while the gap between them is at most
  /// margin·(the larger half extent). Bodies that have `paired[i] == 0` or are infinitely far away or nowhere
  /// are in no pair. `sizesChanged`: whether bodies came, went or grew since the last time. Then insert()
  /// takes each body once, in the order of `bodies`, and end() makes the grid ready.
  void begin(std::span<const Body> bodies, std::span<const std::uint8_t> paired, double margin,
             bool sizesChanged);
  std::uint32_t insert(std::uint32_t index) { ///< the body's slot
    const std::uint32_t slot = starts_[list_[index]]++;
    order_[slot] = index;
    return slot;
  }
  void end();

  [[nodiscard]] std::size_t size() const { return order_.size(); }
  /// By slot: index of the body.
  [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }

  /// Calls visit(slot, first, end) for runs of slots such that `slot` with each of first … end − 1 makes
  /// every pair once that may be near, and some that are not. `centreAt(slot)` is the Point where it was
  /// inserted.
  template <typename CentreAt, typename Visit>
  void forEachRun(CentreAt&& centreAt, Visit&& visit) const {
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      visitWithin(levels_[i], visit);
      for (std::size_t j = i + 1; j < levels_.size(); ++j) {
        visitAcross(levels_[i], levels_[j], centreAt, visit);
      }
    }
    for (std::uint32_t slot = firstUnbounded_; slot < firstAlone_; ++slot) visit(slot, 0U, slot);
  }

private:
  struct Level {
    double cellsPerPixel = 1.0;
    std::uint32_t firstList = 0;                         ///< into starts_
    std::uint32_t mask = 0;                              ///< number of its lists, a power of 2, minus 1
    std::uint32_t leftmost = 0xffffffffU, rightmost = 0; ///< cells of its bodies, of the step before
    std::uint32_t stride = 3;                            ///< lists from a cell to the one below

    void note(double x) { ///< that a body is there
      const std::uint32_t cell = cellOf(x, cellsPerPixel);
      leftmost = cell < leftmost ? cell : leftmost;
      rightmost = cell > rightmost ? cell : rightmost;
    }
  };

  /// Row after row, so that what lies below is near in memory; any 3 × 3 cells have 9 different lists.
  static std::uint32_t listOf(const Level& level, std::uint32_t cellX, std::uint32_t cellY) {
    return (cellX + cellY * level.stride) & level.mask;
  }
  static std::uint32_t listAt(const Level& level, const Point& point) {
    return listOf(level, cellOf(point.x, level.cellsPerPixel), cellOf(point.y, level.cellsPerPixel));
  }
  void findColumns(std::span<const Body> bodies);
  static void chooseStride(Level& level);
  void layOutLevels(std::span<const Body> bodies, std::span<const std::uint8_t> paired, double margin);

  /// Pairs of one level: each body with those behind it in its own cell, with the cell on its right and with
  /// the three below. A list holds cells far from each other too; their bodies are far, so no pair comes
  /// twice but for those that are not near.
  template <typename Visit>
  void visitWithin(const Level& level, Visit& visit) const {
    const std::uint32_t* starts = starts_.data() + level.firstList;
    for (std::uint32_t list = 0; list <= level.mask; ++list) {
      const std::uint32_t end = starts[list + 1];
      const std::uint32_t below = listOf(level, list, 1);
      const bool apart = below == 0 || below == level.mask; // the three lists below are not side by side
      for (std::uint32_t slot = starts[list]; slot < end; ++slot) {
        visit(slot, slot + 1, starts[list < level.mask ? list + 2 : list + 1]);
        if (list == level.mask) visit(slot, starts[0], starts[1]);
        if (!apart) {
          visit(slot, starts[below - 1], starts[below + 2]);
          continue;
        }
        for (std::uint32_t i = 0; i < 3; ++i) {
          const std::uint32_t other = (below + i - 1) & level.mask;
          visit(slot, starts[other], starts[other + 1]);
        }
      }
    }
  }

  /// Pairs of a level and a coarser one, whose cells are so wide that 3 × 3 of them hold every neighbour.
  template <typename CentreAt, typename Visit>
  void visitAcross(const Level& fine, const Level& coarse, CentreAt& centreAt, Visit& visit) const {
    const std::uint32_t end = starts_[fine.firstList + fine.mask + 1];
    const std::uint32_t* starts = starts_.data() + coarse.firstList;
    for (std::uint32_t slot = starts_[fine.firstList]; slot < end; ++slot) {
      const std::uint32_t middle = listAt(coarse, centreAt(slot));
      for (std::uint32_t row = 0; row < 3; ++row) {
        for (std::uint32_t column = 0; column < 3; ++column) {
          const std::uint32_t list = listOf(coarse, middle + column - 1, row - 1);
          visit(slot, starts[list], starts[list + 1]);
        }
      }
    }
  }

  SizeLevels sizes_;
  std::vector<Level> levels_;         ///< the smallest bodies' first
  std::vector<std::uint8_t> level_;   ///< by body: index into levels_; size() unbounded, size() + 1 alone
  std::vector<std::uint32_t> list_;   ///< by body: into starts_
  std::vector<std::uint32_t> starts_; ///< by list, level by level: the first slot; then firstUnbounded_, …
  std::vector<std::uint32_t> order_;
  std::uint32_t firstUnbounded_ = 0; ///< slots from here on are too large for the grid
  std::uint32_t firstAlone_ = 0;     ///< slots from here on are in no pair
};

} // namespace offstage
