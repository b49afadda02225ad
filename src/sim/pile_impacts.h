#pragma once

#include "src/sim/body.h"
#include "src/sim/contact_blocks.h"
#include "src/sim/event.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// Changes the velocities of a contact's bodies by `speed` (px/s) along (x, y), as they share it.
void pushApart(const PileContact& contact, double x, double y, double speed, std::span<SlotState> states);

/// How fast b slips past a along (−ny, nx), px/s.
double slipOf(const PileContact& contact, std::span<const SlotState> states);

/// A wall's event: its side in the order of Side, the body, the coordinate that touched and its velocity.
Event wallEvent(const Event& stamp, std::uint32_t side, std::uint32_t id, double p, double q);

/// The contacts of a step whose bodies meet fast enough to bounce and to be reported.
class PileImpacts {
public:
  struct Impact {
    ContactBlocks::Place place;
    bool isNew;                ///< did not touch in the step before
    bool touched;              ///< has had an impulse
    double closing;            ///< px/s, at the step's start
    double restitution;        ///< share of the closing speed that comes back
    double friction;           ///< Coulomb's coefficient
    double p;                  ///< of its event
    std::uint32_t body, other; ///< as ContactMemory names it
  };

  /// Forgets all. In a step of `bodies` it is seldom that more than every other one meets somebody; what is
  /// reserved and not used is never written to, and growing leaves holes.
  void begin(std::size_t bodies) {
    impacts_.clear();
    impacts_.reserve(bodies / 2);
  }
  void add(const Impact& impact) {
    if (impacts_.size() == impacts_.capacity()) impacts_.reserve(impacts_.size() + impacts_.size() / 4 + 16);
    impacts_.push_back(impact);
  }
  /// Notes which contacts have an impulse now.
  void markTouched(const ContactBlocks& blocks);
  /// Gives those that touched their share of the closing speed back, with friction. Their impulses become 0:
  /// they part, so there is nothing to start the next step from.
  void restitute(ContactBlocks& blocks, std::span<SlotState> states) const;
  /// Appends an event for each that touched and is new, and sorts the events from `firstEvent` on by bodies.
  void report(std::span<const Body> bodies, const Event& stamp, std::size_t firstEvent,
              std::vector<Event>& events) const;

private:
  std::vector<Impact> impacts_;
};

} // namespace offstage
