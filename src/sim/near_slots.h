#pragma once

#include "src/sim/contact_blocks.h"
#include "src/sim/pile_slots.h"
#include "src/sim/two.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace offstage {

// How PileContacts finds out which bodies are near each other. Most of those in neighbouring cells are too
// far apart, and most runs of them are short; which, no processor can foretell. So this goes four at a time
// and without a branch, and a run that is empty costs as much as one of four.

/// Pairs of slots that are near each other and wait to be looked at.
struct NearSlots {
  static constexpr std::uint32_t kMost = 128;
  std::uint32_t count = 0;
  std::array<std::uint32_t, kMost + 4> a, b; ///< and what add() writes beyond them

  /// Takes the pairs of `slot` with those of four slots from `first` on whose bits in `mask` are set. There
  /// has to be room for four.
  void add(std::uint32_t slot, std::uint32_t first, std::uint32_t mask) {
    using Four = std::uint32_t __attribute__((vector_size(16)));
    // By mask: the numbers of its bits, the lowest first.
    static constexpr std::array<Four, 16> kBits{
        Four{0, 0, 0, 0}, Four{0, 0, 0, 0}, Four{1, 0, 0, 0}, Four{0, 1, 0, 0},
        Four{2, 0, 0, 0}, Four{0, 2, 0, 0}, Four{1, 2, 0, 0}, Four{0, 1, 2, 0},
        Four{3, 0, 0, 0}, Four{0, 3, 0, 0}, Four{1, 3, 0, 0}, Four{0, 1, 3, 0},
        Four{2, 3, 0, 0}, Four{0, 2, 3, 0}, Four{1, 2, 3, 0}, Four{0, 1, 2, 3}};
    static constexpr std::array<std::uint8_t, 16> kHowMany{0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};
    const Four slots = slot + Four{};
    const Four others = first + kBits[mask];
    std::memcpy(&a[count], &slots, sizeof slots);
    std::memcpy(&b[count], &others, sizeof others);
    count += kHowMany[mask];
  }
};

/// Whether circles are near each other. SameHalf: PileSlots::sameHalf().
template <bool SameHalf>
class Nearness {
public:
  /// As PileSlots has them; `half` where it is the same for all.
  Nearness(const SlotState* states, const double* halves, double half)
      : states_(states), halves_(halves), squared_(reach(half + Two{}, half + Two{})) {}

  /// A bit for each of four slots from `first` on: whether it is at most as far from `slot` as bodies can be
  /// that meet in the step. Set where one is a rectangle.
  [[nodiscard]] std::uint32_t mask(std::uint32_t slot, std::uint32_t first) const {
    static_assert(PileSlots::kSpare == 4);
    return maskOfTwo(slot, first) | maskOfTwo(slot, first + std::size_t{2}) << 2U;
  }

private:
  static Two reach(const Two& half, const Two& otherHalf) {
    const Two far = (otherHalf + half) * (1.0 + 0.5 * PileSlots::kMargin);
    return far * far;
  }
  [[nodiscard]] std::uint32_t maskOfTwo(std::uint32_t slot, std::size_t other) const {
    const Two centre = load(&states_[slot].x);
    const Two one = load(&states_[other].x) - centre;
    const Two two = load(&states_[other + 1].x) - centre;
    const TwoVectors squares = turned(one * one, two * two);
    const Two far = SameHalf ? squared_ : reach(halves_[slot] + Two{}, load(halves_ + other));
    return maskOf(squares.x + squares.y < far);
  }

  const SlotState* states_;
  const double* halves_;
  Two squared_; ///< px²: where all are the same
};

} // namespace offstage
