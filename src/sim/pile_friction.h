#pragma once

#include "src/sim/contact_blocks.h"
#include "src/sim/contact_memory.h"

#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// The contacts of a step that have friction. Coulomb's law: the impulse along a contact is at most its
/// friction times the impulse across.
class PileFriction {
public:
  struct Rubbing {
    ContactBlocks::Place place;
    double friction;
    double impulse;            ///< px/s, along (−ny, nx)
    std::uint32_t body, other; ///< as ContactMemory names it
  };

  void clear() { rubbings_.clear(); }
  void add(const Rubbing& rubbing) { rubbings_.push_back(rubbing); }
  void warmStart(const ContactBlocks& blocks, std::span<SlotState> states) const;
  /// Takes away what the bodies slip past each other, as far as Coulomb's law lets it.
  void sweep(const ContactBlocks& blocks, std::span<SlotState> states);
  /// Into the entries that are there.
  void remember(ContactMemory& memory) const;

private:
  std::vector<Rubbing> rubbings_;
};

} // namespace offstage
