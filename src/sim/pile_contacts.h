#pragma once

#include "src/sim/body.h"
#include "src/sim/contact_blocks.h"
#include "src/sim/contact_memory.h"
#include "src/sim/event.h"
#include "src/sim/near_slots.h"
#include "src/sim/pile_friction.h"
#include "src/sim/pile_impacts.h"
#include "src/sim/pile_slots.h"
#include "src/sim/rule_table.h"
#include "src/sim/world_setup.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// The contacts of a step of PileSolver: of bodies that touch or may within the step, with each other and
/// with the walls. Finds them, starts them from what they needed in the step before, and remembers them for
/// the next. A wall is a contact with something fixed, whose restitution is the wall's multiplier times the
/// body's and whose friction is the body's.
class PileContacts {
public:
  PileContacts() = default;
  PileContacts(const WorldSetup& setup, const RuleTable& rules);

  /// At the start of a step of length dt. `warmth`, 0 … 1: share of the remembered impulses to start from.
  void find(std::span<const Body> bodies, const PileSlots& slots, double dt, double warmth);
  /// Whether a slot that can move has a contact.
  [[nodiscard]] bool touches(std::uint32_t slot) const { return blocks_.touches(slot); }

  // The sweeps; h: length of a part, s.
  void warmStart(std::span<SlotState> states);
  void solve(std::span<SlotState> states, double h, const Softness& softness);
  void relax(std::span<SlotState> states, double h);
  void restitute(std::span<SlotState> states) { impacts_.restitute(blocks_, states); }

  // After the sweeps.
  void report(std::span<const Body> bodies, const Event& stamp, std::size_t firstEvent,
              std::vector<Event>& events) const {
    impacts_.report(bodies, stamp, firstEvent, events);
  }
  void remember(const PileSlots& slots);
  /// Bodies have gone since the last step. `removed`: by index, 1 for each of them.
  void keepOnly(std::span<const std::uint8_t> removed) { memory_.keepOnly(removed); }

private:
  /// What find() was given, with what it asks for most at hand.
  struct Step {
    std::span<const Body> bodies;
    const PileSlots& slots;
    double dt;
    double warmth;
    const SlotState* states;
    const double* halves; ///< by slot; or all have the same:
    double half;
    const std::uint32_t* order;
    const ContactRule* onlyRule; ///< null when there are several groups
  };
  /// Two bodies that come to a contact.
  struct Meeting {
    std::uint32_t a, b;       ///< slots
    double nx, ny;            ///< as PileContact's
    double touch;             ///< as PileContact's
    double closing, distance; ///< px/s, px
  };
  /// What a contact is beside its geometry.
  struct Material {
    double restitution, friction;
    bool counts; ///< PileSlots::counts() for both
    double p;    ///< of its event
  };

  /// Collects the pairs that may be near. SameHalf: PileSlots::sameHalf().
  template <bool SameHalf>
  void collect(const Step& step);
  template <bool SameHalf>
  void considerAll(const Step& step, NearSlots& candidates);
  void considerShapes(const Step& step, std::uint32_t a, std::uint32_t b);
  void considerWalls(const Step& step, std::uint32_t slot);
  void addPair(const Step& step, const Meeting& meeting);
  void addContact(const Step& step, PileContact& contact, std::uint32_t body, std::uint32_t other,
                  double closing, const Material& material);

  Vec2 pane_ = Vec2::Zero();
  Walls walls_;
  RuleTable rules_;

  ContactBlocks blocks_;
  PileFriction friction_;
  PileImpacts impacts_;
  ContactMemory memory_;
};

} // namespace offstage
