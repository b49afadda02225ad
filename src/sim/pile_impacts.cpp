#include "src/sim/pile_impacts.h"

#include "src/sim/contact_memory.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace offstage {

void pushApart(const PileContact& contact, double x, double y, double speed, std::span<SlotState> states) {
  const double ofA = contact.share * speed;
  const double ofB = speed - ofA;
  SlotState& a = states[contact.a];
  SlotState& b = states[contact.b];
  a.vx -= ofA * x;
  a.vy -= ofA * y;
  b.vx += ofB * x;
  b.vy += ofB * y;
}

double slipOf(const PileContact& contact, std::span<const SlotState> states) {
  const SlotState& a = states[contact.a];
  const SlotState& b = states[contact.b];
  return (b.vy - a.vy) * contact.nx - (b.vx - a.vx) * contact.ny;
}

Event wallEvent(const Event& stamp, std::uint32_t side, std::uint32_t id, double p, double q) {
  static constexpr std::array<EventKind, 4> kKinds{EventKind::Left, EventKind::Right, EventKind::Top,
                                                   EventKind::Bottom};
  Event event = stamp;
  event.kind = kKinds[side];
  event.first = id;
  event.p = p;
  event.q = q;
  return event;
}

void PileImpacts::markTouched(const ContactBlocks& blocks) {
  for (Impact& impact : impacts_) impact.touched = impact.touched || blocks.impulse(impact.place) > 0.0;
}

void PileImpacts::restitute(ContactBlocks& blocks, std::span<SlotState> states) const {
  for (const Impact& impact : impacts_) {
    if (!impact.touched || !(impact.restitution > 0.0)) continue;
    const PileContact c = blocks.contact(impact.place);
    const SlotState& a = states[c.a];
    const SlotState& b = states[c.b];
    const double parting = (b.vx - a.vx) * c.nx + (b.vy - a.vy) * c.ny;
    const double missing = impact.restitution * impact.closing - parting;
    if (missing > 0.0) {
      pushApart(c, c.nx, c.ny, missing, states);
      if (impact.friction > 0.0) { // Coulomb's law holds for this impulse as for those of the sweeps
        const double most = impact.friction * missing;
        pushApart(c, -c.ny, c.nx, std::clamp(-slipOf(c, states), -most, most), states);
      }
    }
    blocks.setImpulse(impact.place, 0.0);
  }
}

void PileImpacts::report(std::span<const Body> bodies, const Event& stamp, std::size_t firstEvent,
                         std::vector<Event>& events) const {
  const auto count = static_cast<std::size_t>(std::count_if(
      impacts_.begin(), impacts_.end(), [](const Impact& impact) { return impact.touched && impact.isNew; }));
  if (events.capacity() < events.size() + count)
    events.reserve(events.size() + std::max(count + count / 4, bodies.size() / 4));
  for (const Impact& impact : impacts_) {
    if (!impact.touched || !impact.isNew) continue;
    if (impact.other >= ContactMemory::kFirstWall) {
      const std::uint32_t side = impact.other - ContactMemory::kFirstWall;
      const double v = side % 2 == 0 ? -impact.closing : impact.closing;
      events.push_back(wallEvent(stamp, side, bodies[impact.body].id, impact.p, v));
    } else {
      Event event = stamp;
      event.kind = EventKind::Collide;
      event.first = bodies[impact.body].id;
      event.second = bodies[impact.other].id;
      event.p = impact.p;
      event.q = impact.closing;
      events.push_back(event);
    }
  }
  // The grid's order means nothing to a reader.
  std::sort(events.begin() + static_cast<std::ptrdiff_t>(firstEvent), events.end(),
            [](const Event& a, const Event& b) {
              return std::tie(a.first, a.second, a.kind) < std::tie(b.first, b.second, b.kind);
            });
}

} // namespace offstage
