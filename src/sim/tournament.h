#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace offstage {

/// Keeps track of which of many is first while one after the other changes: a tree of matches, so that a
/// change costs log₂(players) comparisons (Knuth, The Art of Computer Programming, volume 3, section 5.4.1,
/// "tree selection"). Of two that are equal the lower number wins.
class Tournament {
public:
  static constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

  /// Plays all matches anew among players 0 … `players` − 1. `before(a, b)` tells whether player a is first.
  /// Allocates only when there are more players than ever before.
  template <typename Before>
  void begin(std::size_t players, const Before& before) {
    leaves_ = std::bit_ceil(players + std::size_t{1});
    winners_.assign(2 * leaves_, kNobody);
    for (std::size_t i = 0; i < players; ++i) winners_[leaves_ + i] = static_cast<std::uint32_t>(i);
    for (std::size_t match = leaves_; match-- > 1;) play(match, before);
  }
  /// Plays those of one player again, which has changed.
  template <typename Before>
  void playAgain(std::size_t player, const Before& before) {
    for (std::size_t match = (leaves_ + player) / 2; match > 0; match /= 2) play(match, before);
  }
  /// kNobody when there are no players.
  [[nodiscard]] std::uint32_t winner() const { return winners_[1]; }

private:
  template <typename Before>
  void play(std::size_t match, const Before& before) {
    const std::uint32_t left = winners_[2 * match];
    const std::uint32_t right = winners_[2 * match + 1];
    winners_[match] = right == kNobody || (left != kNobody && !before(right, left)) ? left : right;
  }

  std::size_t leaves_ = 1;
  std::vector<std::uint32_t> winners_{kNobody, kNobody}; ///< of matches 1 …, then of each player's own
};

} // namespace offstage
