#pragma once

#include "src/sim/body.h"
#include "src/sim/contact_blocks.h"
#include "src/sim/pair_grid.h"
#include "src/sim/rule_table.h"
#include "src/sim/world_setup.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// The bodies of a step as PileSolver needs them, side by side in the order of the grid: by slot. Two slots
/// more stand for the fixed outside of the pane and for nobody. What all bodies have in common is kept once.
class PileSlots {
public:
  /// Bodies that are not further apart than this share of the larger one's half extent are found as near.
  static constexpr double kMargin = 0.25;
  /// See counts().
  static constexpr double kRestingSteps = 4.0;

  PileSlots() = default;
  PileSlots(const WorldSetup& setup, const RuleTable& rules);

  /// Bodies have gone since the last gather().
  void bodiesChanged() { changed_ = true; }
  /// Takes the bodies at the start of a step that is made in `parts` of length h.
  void gather(std::span<const Body> bodies, double h, int parts);

  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] std::uint32_t outside() const { return size_; } ///< the slot of what never moves
  [[nodiscard]] const PairGrid& grid() const { return grid_; }
  /// The index of a slot's body.
  [[nodiscard]] std::uint32_t bodyOf(std::uint32_t slot) const { return grid_.order()[slot]; }
  [[nodiscard]] std::span<SlotState> states() { return states_; }
  [[nodiscard]] std::span<const SlotState> states() const { return states_; }
  /// px: a circle's radius; of a rectangle infinite, so that whoever asks only of circles looks closer.
  [[nodiscard]] std::span<const double> halves() const { return {halves_.data(), size_}; }
  /// 1/mass; of a fixed body 0.
  [[nodiscard]] double weight(std::uint32_t slot) const { return sameWeight_ ? weight_ : weights_[slot]; }
  /// All have one mass and none is fixed.
  [[nodiscard]] bool sameWeight() const { return sameWeight_; }
  /// px/s: what acceleration makes of a velocity in a part. Of what is fixed any.
  [[nodiscard]] const Vec2& gained(std::uint32_t slot) const { return gained_[sameGain_ ? 0 : slot]; }
  [[nodiscard]] Vec2 gainedInStep(std::uint32_t slot) const { return gained(slot) * parts_; }
  /// Whether a closing speed (px/s) is more than kRestingSteps times what the body's own acceleration makes
  /// of it in a step. Slower ones neither bounce nor are reported; else a pile would never come to rest.
  [[nodiscard]] bool counts(double closing, std::uint32_t slot) const {
    if (!(closing > 0.0)) return false;
    return closing * closing >
           (sameGain_ ? restingGain_ : restingSquared_ * dot(gained_[slot], gained_[slot]));
  }
  /// The group's number in the rules. Not where there is only one.
  [[nodiscard]] std::uint32_t group(std::uint32_t slot) const { return groups_[slot]; }

  /// Every body moves by semi-implicit Euler and there are no forces.
  [[nodiscard]] bool uniform() const { return uniform_; }
  /// No body has a friction or a restitution of its own.
  [[nodiscard]] bool plain() const { return plain_; }

private:
  void learn(std::span<const Body> bodies);

  Vec2 gravity_ = Vec2::Zero();
  bool forces_ = false;
  RuleTable rules_;
  bool changed_ = true;

  // Of all bodies.
  bool uniform_ = true;
  bool plain_ = true;
  bool sameGain_ = true;             ///< all that move accelerate alike, not counting forces
  bool sameWeight_ = true;           ///< all have one mass and none is fixed
  std::uint32_t someMoving_ = 0;     ///< index of one of them
  std::vector<std::uint8_t> paired_; ///< by index; 1: has a rule

  PairGrid grid_;
  double parts_ = 1.0;          ///< of the step
  double restingSquared_ = 0.0; ///< kRestingSteps in parts, squared
  double restingGain_ = 0.0;    ///< what counts() compares with where sameGain_
  std::uint32_t size_ = 0;
  std::vector<SlotState> states_;
  std::vector<double> halves_;  ///< and one more, so that two can be loaded at a time
  double weight_ = 0.0;         ///< where sameWeight_
  std::vector<double> weights_; ///< by slot, where not
  std::vector<Vec2> gained_;    ///< one where they are all the same
  std::vector<std::uint32_t> groups_;
};

} // namespace offstage
