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
  /// Bodies that are not further apart than this share of the smaller one's half extent are in contact before
  /// they touch, so that they meet within the step; those that close in faster up to kMargin.
  static constexpr double kSlack = 0.1;
  /// See counts().
  static constexpr double kRestingSteps = 4.0;

  PileSlots() = default;
  PileSlots(const WorldSetup& setup, const RuleTable& rules);

  /// Bodies have gone since the last gather().
  void bodiesChanged() { changed_ = true; }
  /// Bodies are no longer where countAtEnd() saw them.
  void bodiesMoved() { counted_ = false; }
  /// Takes the bodies at the start of a step that is made in `parts` of length dt/parts.
  void gather(std::span<const Body> bodies, double dt, int parts);

  /// At the end of a step, while the bodies are at hand: has them all counted where they are now, so that
  /// gather() need not look at them twice.
  PairGrid::Counting countAtEnd() {
    counted_ = true;
    return grid_.startCounting();
  }

  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] std::uint32_t outside() const { return size_; } ///< the slot of what never moves
  [[nodiscard]] const PairGrid& grid() const { return grid_; }
  /// The index of a slot's body.
  [[nodiscard]] std::uint32_t bodyOf(std::uint32_t slot) const { return grid_.order()[slot]; }
  [[nodiscard]] std::span<SlotState> states() { return states_; }
  [[nodiscard]] std::span<const SlotState> states() const { return states_; }
  /// px: a circle's radius; of a rectangle infinite, so that whoever asks only of circles looks closer.
  [[nodiscard]] double half(std::uint32_t slot) const { return sameHalf_ ? half_ : halves_[slot]; }
  /// All are circles of one radius.
  [[nodiscard]] bool sameHalf() const { return sameHalf_; }
  /// By slot. Not where they are all the same.
  [[nodiscard]] std::span<const double> halves() const { return halves_; }
  /// Of states() and halves(): more may be read, for the sake of those that look at several at a time.
  static constexpr std::uint32_t kSpare = 4;
  /// Slots of bodies that can move and may come to an edge of the pane within the step; of rectangles all.
  [[nodiscard]] std::span<const std::uint32_t> atEdges() const { return atEdges_; }
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
  [[nodiscard]] bool mayReachEdge(std::uint32_t slot, double dt) const;

  Vec2 pane_ = Vec2::Zero();
  Vec2 gravity_ = Vec2::Zero();
  bool forces_ = false;
  RuleTable rules_;
  bool changed_ = true;
  bool counted_ = false; ///< the grid has counted the bodies where they are now

  // Of all bodies.
  bool uniform_ = true;
  bool plain_ = true;
  bool sameGain_ = true;             ///< all that move accelerate alike, not counting forces
  bool sameWeight_ = true;           ///< all have one mass and none is fixed
  bool sameHalf_ = true;             ///< all are circles of one radius
  std::uint32_t someMoving_ = 0;     ///< index of one of them
  std::vector<std::uint8_t> paired_; ///< by index; 1: has a rule

  PairGrid grid_;
  double parts_ = 1.0;          ///< of the step
  double restingSquared_ = 0.0; ///< kRestingSteps in parts, squared
  double restingGain_ = 0.0;    ///< what counts() compares with where sameGain_
  std::uint32_t size_ = 0;
  std::vector<SlotState> states_;
  double half_ = 0.0;           ///< where sameHalf_
  std::vector<double> halves_;  ///< by slot, where not
  double weight_ = 0.0;         ///< where sameWeight_
  std::vector<double> weights_; ///< by slot, where not
  std::vector<Vec2> gained_;    ///< one where they are all the same
  std::vector<std::uint32_t> groups_;
  std::vector<std::uint32_t> atEdges_;
};

} // namespace offstage
