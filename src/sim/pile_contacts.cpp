#include "src/sim/pile_contacts.h"

#include "src/sim/contact.h"
#include "src/sim/two.h"
#include "src/sim/walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace offstage {
namespace {

/// The smaller half extent.
double thinness(const Body& body) {
  return body.shape == Shape::Circle ? body.radius : 0.5 * std::min(body.size.x(), body.size.y());
}

std::uint32_t sideOf(const PileContact& wall) {
  if (wall.nx != 0.0) return wall.nx < 0.0 ? 0 : 1;
  return wall.ny < 0.0 ? 2 : 3;
}

} // namespace

PileContacts::PileContacts(const WorldSetup& setup, const RuleTable& rules)
    : pane_(setup.pane), walls_(setup.walls), rules_(rules) {}

[[gnu::always_inline]] inline void PileContacts::addContact(const Step& step, PileContact& contact,
                                                            std::uint32_t body, std::uint32_t other,
                                                            double closing, const Material& material) {
  const ContactMemory::Entry* before = memory_.find(body, other);
  if (before != nullptr) contact.impulse = step.warmth * static_cast<double>(before->impulse);
  const ContactBlocks::Place place = blocks_.add(contact);
  if (material.friction > 0.0) {
    const double rubbing =
        before != nullptr ? step.warmth * static_cast<double>(memory_.rubbing(*before)) : 0.0;
    friction_.add({place, material.friction, rubbing, body, other});
  }
  if (material.counts) {
    impacts_.add({place, before == nullptr, false, closing, material.restitution, material.friction,
                  material.p, body, other});
  }
}

[[gnu::always_inline]] inline void PileContacts::addPair(const Step& step, const Meeting& meeting) {
  const PileSlots& slots = step.slots;
  const std::uint32_t a = meeting.a;
  const std::uint32_t b = meeting.b;
  double share = 0.5;
  if (!slots.sameWeight()) {
    const double weight = slots.weight(a) + slots.weight(b);
    if (!(weight > 0.0)) return; // both fixed
    share = slots.weight(a) / weight;
  }
  const ContactRule* rule =
      step.onlyRule != nullptr ? step.onlyRule : rules_.find(slots.group(a), slots.group(b));
  if (rule == nullptr) return;
  const std::uint32_t i = step.order[a];
  const std::uint32_t j = step.order[b];
  Material material{rule->restitution, 0.0,
                    slots.counts(meeting.closing, a) && slots.counts(meeting.closing, b), meeting.distance};
  if (!slots.plain()) {
    material.restitution *= pairOf(step.bodies[i].restitution, step.bodies[j].restitution);
    material.friction = pairOf(step.bodies[i].friction, step.bodies[j].friction);
  }
  PileContact contact{a, b, meeting.nx, meeting.ny, meeting.touch, share, 0.0};
  addContact(step, contact, std::min(i, j), std::max(i, j), meeting.closing, material);
}

void PileContacts::find(std::span<const Body> bodies, const PileSlots& slots, double dt, double warmth) {
  blocks_.begin(slots.size() + std::size_t{1}, slots.sameWeight());
  friction_.clear();
  impacts_.begin(slots.size());
  const Step step{bodies,
                  slots,
                  dt,
                  warmth,
                  slots.states().data(),
                  slots.halves().data(),
                  slots.half(0),
                  slots.grid().order().data(),
                  rules_.groups() == 1 ? rules_.find(0, 0) : nullptr};
  slots.sameHalf() ? collect<true>(step) : collect<false>(step);
  for (const std::uint32_t slot : slots.atEdges()) considerWalls(step, slot);
}

template <bool SameHalf>
void PileContacts::collect(const Step& step) {
  NearSlots candidates; // NOLINT(cppcoreguidelines-pro-type-member-init): filled before they are read
  const Nearness<SameHalf> nearness{step.states, step.halves, step.half};
  step.slots.grid().forEachRun(
      [&](std::uint32_t slot) {
        return PairGrid::Point{step.states[slot].x, step.states[slot].y};
      },
      [&](std::uint32_t slot, std::uint32_t first, std::uint32_t end) {
        std::int64_t left = std::int64_t{end} - std::int64_t{first};
        do {
          if (candidates.count > NearSlots::kMost - 4) considerAll<SameHalf>(step, candidates);
          const std::uint32_t there = (1U << std::min(left, std::int64_t{4})) - 1U;
          candidates.add(slot, first, nearness.mask(slot, first) & there);
          first += 4;
          left -= 4;
        } while (left > 0);
      });
  considerAll<SameHalf>(step, candidates);
}

/// Adds those of the candidates that touch or may do so in the step, and forgets them all.
template <bool SameHalf>
void PileContacts::considerAll(const Step& step, NearSlots& candidates) {
  std::array<Meeting, NearSlots::kMost> meetings; // NOLINT(cppcoreguidelines-pro-type-member-init)
  std::size_t count = 0;
  const SlotState* const states = step.states;
  candidates.a[candidates.count] = candidates.b[candidates.count] = 0; // beside the last of an odd number
  for (std::uint32_t i = 0; i < candidates.count; i += 2) {
    const std::array<std::uint32_t, 2> a{candidates.a[i], candidates.a[i + 1]};
    const std::array<std::uint32_t, 2> b{candidates.b[i], candidates.b[i + 1]};
    const Two half = SameHalf ? step.half + Two{} : Two{step.halves[a[0]], step.halves[a[1]]};
    const Two otherHalf = SameHalf ? half : Two{step.halves[b[0]], step.halves[b[1]]};
    const Two touch = half + otherHalf;
    const TwoVectors from = turned(load(&states[a[0]].x), load(&states[a[1]].x));
    const TwoVectors to = turned(load(&states[b[0]].x), load(&states[b[1]].x));
    const Two dx = to.x - from.x;
    const Two dy = to.y - from.y;
    const Two distance = squareRoot(dx * dx + dy * dy);
    const auto apart = distance > Two{};
    const Two nx = select(apart, dx / distance, Two{1.0, 1.0});
    const Two ny = select(apart, dy / distance, Two{});
    const TwoVectors speed = turned(load(&states[a[0]].vx), load(&states[a[1]].vx));
    const TwoVectors otherSpeed = turned(load(&states[b[0]].vx), load(&states[b[1]].vx));
    const Two closing = (speed.x - otherSpeed.x) * nx + (speed.y - otherSpeed.y) * ny;
    const Two way = distance - touch - (closing > Two{} ? closing : Two{}) * step.dt;
    const auto isNear = way <= (half < otherHalf ? half : otherHalf) * PileSlots::kSlack;
    for (std::uint32_t lane = 0; lane < 2; ++lane) {
      if (!SameHalf && std::isinf(touch[lane])) {
        if (i + lane < candidates.count) considerShapes(step, a[lane], b[lane]);
        continue;
      }
      meetings[count] = {a[lane], b[lane], nx[lane], ny[lane], touch[lane], closing[lane], distance[lane]};
      count +=
          static_cast<std::size_t>(isNear[lane] != 0) & static_cast<std::size_t>(i + lane < candidates.count);
    }
  }
  candidates.count = 0;
  for (std::size_t i = 0; i < count; ++i) addPair(step, meetings[i]);
}

void PileContacts::considerShapes(const Step& step, std::uint32_t a, std::uint32_t b) {
  const Body& first = step.bodies[step.slots.bodyOf(a)];
  const Body& second = step.bodies[step.slots.bodyOf(b)];
  // A thin floor is as good as a thick one.
  const double smaller = first.fixed    ? thinness(second)
                         : second.fixed ? thinness(first)
                                        : std::min(thinness(first), thinness(second));
  const auto contact = findContact(first, second, PileSlots::kMargin * smaller);
  if (!contact) return;
  const double closing = closingSpeed(*contact, first, second);
  const double gap = contact->distance - contact->touch;
  if (gap - std::max(closing, 0.0) * step.dt > PileSlots::kSlack * smaller) return;
  const SlotState& from = step.states[a];
  const SlotState& to = step.states[b];
  const double nx = contact->normal.x();
  const double ny = contact->normal.y();
  const double touch = ((to.x - from.x) * nx + (to.y - from.y) * ny) - gap;
  addPair(step, {a, b, nx, ny, touch, closing, contact->distance});
}

void PileContacts::considerWalls(const Step& step, std::uint32_t slot) {
  const PileSlots& slots = step.slots;
  const SlotState& state = step.states[slot];
  const Vec2 gained = slots.gainedInStep(slot);
  const Body& body = step.bodies[slots.bodyOf(slot)];
  for (std::uint32_t side = 0; side < 4; ++side) {
    const std::optional<double>& multiplier = walls_.restitution[side];
    if (!multiplier) continue;
    const int axis = side < 2 ? 0 : 1;
    const bool lower = side % 2 == 0;
    const double x = body.position[axis];
    const Reach reach = reachOf(body, axis);
    const double gap = lower ? x - reach.before : pane_[axis] - (x + reach.after);
    const double sign = lower ? -1.0 : 1.0; // of the way out
    const double closing = sign * body.velocity[axis];
    const double way = std::max(closing + std::max(sign * gained[axis], 0.0), 0.0) * step.dt;
    if (!(gap - way <= PileSlots::kSlack * thinness(body))) continue;
    const double touch = -sign * (axis == 0 ? state.x : state.y) - gap; // the outside lies at 0
    PileContact contact{slot, slots.outside(), axis == 0 ? sign : 0.0, axis == 1 ? sign : 0.0, touch, 1.0,
                        0.0};
    addContact(step, contact, slots.bodyOf(slot), ContactMemory::kFirstWall + side, closing,
               {*multiplier * body.restitution, body.friction, slots.counts(closing, slot), x});
  }
}

void PileContacts::warmStart(std::span<SlotState> states) {
  blocks_.warmStart(states);
  friction_.warmStart(blocks_, states);
}

void PileContacts::solve(std::span<SlotState> states, double h, const Softness& softness) {
  blocks_.solve(states, h, softness);
  friction_.sweep(blocks_, states);
}

void PileContacts::relax(std::span<SlotState> states, double h) {
  impacts_.markTouched(blocks_); // before and after: a contact may end here, and one that was just reached
                                 // begins here
  blocks_.relax(states, h);
  friction_.sweep(blocks_, states);
  impacts_.markTouched(blocks_);
}

void PileContacts::remember(const PileSlots& slots) {
  memory_.remember(slots.size(), [&](auto&& visit) {
    blocks_.forEach([&](const PileContact& contact) {
      if (!(contact.impulse > 0.0)) return;
      const auto impulse = static_cast<float>(contact.impulse);
      const std::uint32_t i = slots.bodyOf(contact.a);
      if (contact.b == slots.outside()) {
        visit(i, ContactMemory::Entry{ContactMemory::kFirstWall + sideOf(contact), impulse});
      } else {
        const std::uint32_t j = slots.bodyOf(contact.b);
        visit(std::min(i, j), ContactMemory::Entry{std::max(i, j), impulse});
      }
    });
  });
  friction_.remember(memory_);
}

} // namespace offstage
