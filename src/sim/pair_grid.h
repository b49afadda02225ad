#pragma once

#include "src/sim/body.h"
#include "src/sim/size_levels.h"
#include "src/sim/two.h"

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

private:
  struct Level {
    double cellsPerPixel = 1.0;
    std::uint32_t firstList = 0;                         ///< into starts_
    std::uint32_t mask = 0;                              ///< number of its lists, a power of 2, minus 1
    std::uint32_t leftmost = 0xffffffffU, rightmost = 0; ///< cells of its bodies, of the step before
    std::uint32_t stride = 3;                            ///< lists from a cell to the one below

    void note(std::uint32_t cellX) { ///< that a body is there
      leftmost = cellX < leftmost ? cellX : leftmost;
      rightmost = cellX > rightmost ? cellX : rightmost;
    }
  };
  struct Cell {
    std::uint32_t x, y; ///< 0 … 2^31
  };

  /// The cell that a finite point lies in; what is beyond 2^30 cells of 0 counts as there. A cell begins half
  /// a cell before its number's place, for the sum leaves the nearest whole number in its lowest bits.
  static Cell cellAt(const Level& level, const Point& point) {
    constexpr double kFarthest = 1 << 30;
    constexpr double kToLowestBits = 0x1.8p52 + kFarthest;
    Two cells = load(&point.x) * level.cellsPerPixel;
    cells = cells > -kFarthest ? cells : -kFarthest + Two{};
    cells = cells < kFarthest ? cells : kFarthest + Two{};
    const auto bits = reinterpret_cast<TwoBits>(cells + kToLowestBits);
    return {static_cast<std::uint32_t>(bits[0]), static_cast<std::uint32_t>(bits[1])};
  }

  /// Row after row, so that what lies below is near in memory; any 3 × 3 cells have 9 different lists.
  static std::uint32_t listOf(const Level& level, std::uint32_t cellX, std::uint32_t cellY) {
    return (cellX + cellY * level.stride) & level.mask;
  }
  static std::uint32_t listAt(const Level& level, const Point& point) {
    const Cell cell = cellAt(level, point);
    return listOf(level, cell.x, cell.y);
  }

public:
  static Point centreOf(const Body& body) {
    if (body.shape == Shape::Circle) return {body.position.x(), body.position.y()};
    const Vec2 centre = body.position + body.size * 0.5;
    return {centre.x(), centre.y()};
  }

  /// Chooses the levels, at first and whenever bodies came, went or grew. `margin`: two bodies are near while
  /// the gap between them is at most margin·(the larger half extent). Bodies that have `paired[i] == 0` or
  /// are infinitely far away or nowhere are in no pair.
  void layOut(std::span<const Body> bodies, std::span<const std::uint8_t> paired, double margin);

  /// The grid is filled in two rounds: first every body is counted, in any order, then every one is inserted,
  /// in the order of `bodies`. A Counting is the first round; it is good while nothing else is done with the
  /// grid. It has what it needs at hand, for a compiler cannot know that stores of vectors leave a grid
  /// alone.
  class Counting {
  public:
    void add(std::uint32_t index, const Point& centre) {
      std::uint32_t list = unbounded_ + 1; // those alone
      const std::size_t number = numbers_[index];
      if (number <= levelCount_ && bothFinite(load(&centre.x))) {
        list = unbounded_;
        if (number < levelCount_) {
          Level& level = levels_[number];
          const Cell cell = cellAt(level, centre);
          level.note(cell.x);
          list = level.firstList + listOf(level, cell.x, cell.y);
        }
      }
      lists_[index] = list;
      ++starts_[list + 1];
    }

  private:
    friend class PairGrid;
    explicit Counting(PairGrid& grid);
    Level* levels_;
    std::size_t levelCount_;
    const std::uint8_t* numbers_; ///< by body: PairGrid::level_
    std::uint32_t* lists_;
    std::uint32_t* starts_;
    std::uint32_t unbounded_; ///< behind all lists: the unbounded, then those alone
  };
  Counting startCounting();
  void startInserting();
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
  void findColumns(std::span<const Body> bodies);
  static void chooseStride(Level& level);

  /// Pairs of one level: each body with those behind it in its own cell, with the cell on its right and with
  /// the three below. A list holds cells far from each other too; their bodies are far, so no pair comes
  /// twice but for those that are not near.
  template <typename Visit>
  void visitWithin(const Level& level, Visit& visit) const {
    const std::uint32_t* starts = starts_.data() + level.firstList;
    for (std::uint32_t list = 0; list <= level.mask; ++list) {
      const std::uint32_t end = starts[list + 1];
      if (starts[list] == end) continue;
      const std::uint32_t below = listOf(level, list, 1);
      if (list == level.mask || below == 0 || below == level.mask) {
        visitAtSeam(level, list, visit);
        continue;
      }
      const std::uint32_t right = starts[list + 2];
      const std::uint32_t firstBelow = starts[below - 1];
      const std::uint32_t endBelow = starts[below + 2];
      for (std::uint32_t slot = starts[list]; slot < end; ++slot) {
        visit(slot, slot + 1, right);
        visit(slot, firstBelow, endBelow);
      }
    }
  }

  /// visitWithin() for a list whose neighbours are at both ends of the lists.
  template <typename Visit>
  [[gnu::noinline]] void visitAtSeam(const Level& level, std::uint32_t list, Visit& visit) const {
    const std::uint32_t* starts = starts_.data() + level.firstList;
    const std::uint32_t right = (list + 1) & level.mask;
    const std::uint32_t below = listOf(level, list, 1);
    for (std::uint32_t slot = starts[list]; slot < starts[list + 1]; ++slot) {
      visit(slot, slot + 1, starts[list + 1]);
      visit(slot, starts[right], starts[right + 1]);
      for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t other = (below + i - 1) & level.mask;
        visit(slot, starts[other], starts[other + 1]);
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
