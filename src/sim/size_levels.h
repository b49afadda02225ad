#pragma once

#include "src/sim/body.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace offstage {

/// A circle's diameter, a rectangle's longer side, px.
double extentOf(const Body& body);

/// Sorts bodies by size for a grid of several levels: those of a level have extents within a factor of 4 of
/// each other. Points go with the smallest bodies that have an extent.
class SizeLevels {
public:
  static constexpr std::uint32_t kUnbounded = std::numeric_limits<std::uint32_t>::max();

  // First count() every extent, then layOut(), then ask.
  void clear() { counts_.fill(0); }
  void count(double extent) { ++counts_[octaveOf(extent)]; }
  void layOut();

  /// How many bodies each level has, the smallest bodies' level first. Those of kUnbounded are in none.
  [[nodiscard]] std::span<const std::uint32_t> members() const { return members_; }
  /// The level of a counted extent; kUnbounded when it is too large for any grid (or NaN).
  [[nodiscard]] std::uint32_t levelOf(double extent) const { return levelOf_[octaveOf(extent)]; }

private:
  static constexpr std::size_t kOctaves = 128; ///< 2^-64 px … 2^64 px; the first is also for points
  static std::size_t octaveOf(double extent);  ///< kOctaves: too large, or NaN

  std::array<std::uint32_t, kOctaves + 1> counts_{};
  std::array<std::uint32_t, kOctaves + 1> levelOf_{};
  std::vector<std::uint32_t> members_;
};

/// The number of the cell that a finite position lies in, in cells of 1/cellsPerPixel px: 0 … 2^31. Never
/// decreases with the position; what lies beyond 2^30 cells of 0 counts as there.
inline std::uint32_t cellOf(double position, double cellsPerPixel) {
  constexpr double kFarthest = 1 << 30;
  double cell = position * cellsPerPixel;
  cell = cell > -kFarthest ? cell : -kFarthest;
  cell = cell < kFarthest ? cell : kFarthest;
  return static_cast<std::uint32_t>(
      static_cast<std::int64_t>(cell + kFarthest)); // of a positive number: its floor
}

/// Where a cell is listed in a table of mask + 1 lists, a power of 2 from 32 on. Neighbours in a row are
/// neighbours in the table, the odd factor spreads the rows (2^32 over the golden ratio; Knuth, The Art of
/// Computer Programming, volume 3, section 6.4), and any 3 × 3 cells have 9 different lists.
inline std::uint32_t listOf(std::uint32_t cellX, std::uint32_t cellY, std::uint32_t mask) {
  return (cellX + cellY * 2654435769U) & mask;
}

} // namespace offstage
