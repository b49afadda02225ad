#include "src/sim/pile_friction.h"

#include "src/sim/pile_impacts.h"

#include <algorithm>

namespace offstage {

void PileFriction::warmStart(const ContactBlocks& blocks, std::span<SlotState> states) const {
  for (const Rubbing& rubbing : rubbings_) {
    const PileContact c = blocks.contact(rubbing.place);
    pushApart(c, -c.ny, c.nx, rubbing.impulse, states);
  }
}

void PileFriction::sweep(const ContactBlocks& blocks, std::span<SlotState> states) {
  for (Rubbing& rubbing : rubbings_) {
    const PileContact c = blocks.contact(rubbing.place);
    const double most = rubbing.friction * c.impulse;
    const double impulse = std::clamp(rubbing.impulse - slipOf(c, states), -most, most);
    pushApart(c, -c.ny, c.nx, impulse - rubbing.impulse, states);
    rubbing.impulse = impulse;
  }
}

void PileFriction::remember(ContactMemory& memory) const {
  for (const Rubbing& rubbing : rubbings_) {
    if (const ContactMemory::Entry* entry = memory.find(rubbing.body, rubbing.other)) {
      memory.setRubbing(*entry, static_cast<float>(rubbing.impulse));
    }
  }
}

} // namespace offstage
