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

/// Bodies that are not further apart than this share of the smaller one's half extent are in contact before
/// they touch, so that they meet within the step; those that close in faster up to PileSlots::kMargin.
constexpr double kSlack = 0.1;

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
    impacts_.add({place, closing, material.restitution, material.p, body, other, before == nullptr});
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
  blocks_.begin(slots.size() + std::size_t{1});
  friction_.clear();
  impacts_.clear();
  const Step step{bodies,
                  slots,
                  dt,
                  warmth,
                  slots.states().data(),
                  slots.halves().data(),
                  slots.grid().order().data(),
                  rules_.groups() == 1 ? rules_.find(0, 0) : nullptr};
  Candidates candidates; // NOLINT(cppcoreguidelines-pro-type-member-init): filled before they are read
  slots.grid().forEachRun(
      [&](std::uint32_t slot) {
        return PairGrid::Point{step.states[slot].x, step.states[slot].y};
      },
      [&](std::uint32_t slot, std::uint32_t first, std::uint32_t end) {
        constexpr std::uint32_t kAtOnce = 32;
        for (; first < end; first += std::min(kAtOnce, end - first)) {
          if (candidates.count + kAtOnce > Candidates::kMost) considerAll(step, candidates);
          considerRun(step, slot, first, std::min(end, first + kAtOnce), candidates);
        }
      });
  considerAll(step, candidates);
  for (std::uint32_t slot = 0; slot < slots.size(); ++slot) considerWalls(step, slot);
}

/// Most pairs of a run are too far apart; those that are not are picked out two at a time and without a
/// branch.
inline void PileContacts::considerRun(const Step& step, std::uint32_t slot, std::uint32_t first,
                                      std::uint32_t end, Candidates& candidates) {
  const SlotState* const states = step.states;
  const double* const halves = step.halves;
  const Two centre = load(&states[slot].x);
  const Two half = halves[slot] + Two{};
  std::uint32_t count = candidates.count;
  for (std::uint32_t other = first; other < end; other += 2) {
    const Two one = load(&states[other].x) - centre;
    const Two two = load(&states[other + 1].x) - centre;
    const TwoVectors squares = turned(one * one, two * two);
    // At least what considerAll() asks of the two; infinite where one is a rectangle.
    const Two far = (load(halves + other) + half) * (1.0 + 0.5 * PileSlots::kMargin);
    const auto isNear = squares.x + squares.y < far * far; // −1 or 0
    candidates.a[count] = slot;
    candidates.b[count] = other;
    count -= static_cast<std::uint32_t>(isNear[0]);
    candidates.a[count] = slot;
    candidates.b[count] = other + 1;
    count -= static_cast<std::uint32_t>(isNear[1]);
  }
  // Of an odd number one was too many.
  if (count > candidates.count && candidates.b[count - 1] == end) --count;
  candidates.count = count;
}

/// Adds those of the candidates that touch or may do so in the step, and forgets them all.
void PileContacts::considerAll(const Step& step, Candidates& candidates) {
  std::array<Meeting, Candidates::kMost> meetings; // NOLINT(cppcoreguidelines-pro-type-member-init)
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < candidates.count; ++i) {
    const std::uint32_t a = candidates.a[i];
    const std::uint32_t b = candidates.b[i];
    const double half = step.halves[a];
    const double otherHalf = step.halves[b];
    const double touch = half + otherHalf;
    if (std::isinf(touch)) {
      considerShapes(step, a, b);
      continue;
    }
    const SlotState& first = step.states[a];
    const SlotState& second = step.states[b];
    const double dx = second.x - first.x;
    const double dy = second.y - first.y;
    const double distance = std::sqrt(dx * dx + dy * dy);
    const bool apart = distance > 0.0;
    const double nx = apart ? dx / distance : 1.0;
    const double ny = apart ? dy / distance : 0.0;
    const double closing = (first.vx - second.vx) * nx + (first.vy - second.vy) * ny;
    meetings[count] = {a, b, nx, ny, touch, closing, distance};
    const double way = distance - touch - std::max(closing, 0.0) * step.dt;
    count += static_cast<std::size_t>(way <= kSlack * std::min(half, otherHalf));
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
  if (gap - std::max(closing, 0.0) * step.dt > kSlack * smaller) return;
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
  const double wide = step.halves[slot] * (1.0 + kSlack);
  const double farX = wide + (std::abs(state.vx) + std::abs(gained.x())) * step.dt;
  const double farY = wide + (std::abs(state.vy) + std::abs(gained.y())) * step.dt;
  if (state.x > farX && state.x < pane_.x() - farX && state.y > farY && state.y < pane_.y() - farY) return;
  if (!(slots.weight(slot) > 0.0)) return;
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
    if (!(gap - way <= kSlack * thinness(body))) continue;
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
