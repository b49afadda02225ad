#pragma once

#include "src/sim/body.h"
#include "src/sim/size_levels.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace offstage {

/// Tells which bodies may touch a given one, so that not every pair has to be tried. It may name too many,
/// never too few: findContact() of a body that it leaves out finds nothing, whatever the rounding.
///
/// Bodies whose extents (a circle's diameter, a rectangle's longer side) lie within a factor of 4 share a
/// level; a level is a uniform grid with cells as wide as its largest body, and a body lies in the cell of
/// its position. So a query looks at about 3 × 3 cells of each level, and at a level's bodies one by one
/// where that is less. Cells are found by hashing: the pane's size does not matter, nor do bodies far
/// outside of it.
///
/// Within a pass a body may be moved or taken out; both take constant time. Members are named by their index
/// in the span that begin() was given, in ascending order.
class Broadphase {
public:
  /// A new pass over `members`, the bodies (indices into `bodies`) that may touch somebody. Allocates only
  /// when there are more of them than ever before.
  void begin(std::span<const Body> bodies, std::span<const std::uint32_t> members);

  /// The member touches nobody any more.
  void remove(std::uint32_t member);

  /// The member, which has not been removed, is now where `body` is. Its shape and size are as they were.
  void move(std::uint32_t member, const Body& body);

  /// Fills `found` with all members that are left and may touch `body`, ascending, where it is or within
  /// `margin` (px, per axis) of there.
  void query(const Body& body, double margin, std::vector<std::uint32_t>& found) const;

private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// How far a body reaches from its position along both axes: a circle by its radius both ways, a
  /// rectangle, whose position is its upper-left corner, by its size one way.
  struct Reach {
    Vec2 before = Vec2::Zero();
    Vec2 after = Vec2::Zero();
  };
  struct Level {
    Reach reach;                ///< the largest of its bodies'
    double cellsPerPixel = 0.0; ///< 1/(side of a cell)
    std::uint32_t firstHead = 0;
    std::uint32_t mask = 0;                     ///< number of heads, a power of 2, minus 1
    std::uint32_t firstMember = 0, members = 0; ///< its part of byLevel_
  };
  struct Cell {
    std::uint32_t x, y;
    bool operator==(const Cell&) const = default;
  };
  struct Entry {
    double x = 0.0, y = 0.0;
    Cell cell{};
    std::uint32_t next = kNone, previous = kNone; ///< in the list of its head
    std::uint32_t head = kNone;                   ///< into heads_; kNone while in no list
    std::uint32_t level = 0;                      ///< into levels_; kNone: compared with everybody
  };

  static Reach reachOf(const Body& body);
  static Cell cellAt(const Level& level, const Vec2& position);
  static std::uint32_t headOf(const Level& level, Cell cell);
  void layOutLevels(std::span<const Body> bodies, std::span<const std::uint32_t> members);
  void insert(std::uint32_t member, const Body& body);
  void queryLevel(const Level& level, const Body& body, double margin,
                  std::vector<std::uint32_t>& found) const;

  SizeLevels sizes_;
  std::vector<Level> levels_;
  std::vector<Entry> entries_;           ///< by member
  std::vector<std::uint32_t> heads_;     ///< of all levels: the first member of a list
  std::vector<std::uint32_t> byLevel_;   ///< members, level by level
  std::vector<std::uint32_t> unbounded_; ///< members that are compared with everybody
};

} // namespace offstage
