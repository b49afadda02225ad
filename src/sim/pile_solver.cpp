#include "src/sim/pile_solver.h"

#include "src/sim/rule_table.h"
#include "src/sim/two.h"
#include "src/sim/walls.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace offstage {
namespace {

/// Catto's soft contact for parts of length h; rates are in 1/h, and pi is written out so that no library
/// has a say in its bits.
Softness softness(double h) {
  constexpr double kDampingRatio = 5.0;
  constexpr double kOmega = 2.0 * 3.14159265358979323846 * 0.25; // times h: a quarter of the parts' rate
  constexpr double kA1 = 2.0 * kDampingRatio + kOmega;
  constexpr double kA2 = kOmega * kA1;
  constexpr double kA3 = 1.0 / (1.0 + kA2);
  return {kOmega / kA1 / h, kA2 * kA3, kA3};
}

RuleTable bounceRules(const WorldSetup& setup) {
  std::vector<ContactRule> bounces;
  for (const ContactRule& rule : setup.contacts) {
    if (rule.response == Response::Bounce) bounces.push_back(rule);
  }
  return RuleTable(bounces);
}

} // namespace

PileSolver::PileSolver(const WorldSetup& setup)
    : pane_(setup.pane),
      walls_(setup.walls),
      substeps_(setup.substeps),
      iterations_(setup.iterations),
      slots_(setup, bounceRules(setup)),
      contacts_(setup, bounceRules(setup)) {}

void PileSolver::keepOnly(std::span<const std::uint8_t> removed) {
  contacts_.keepOnly(removed);
  slots_.bodiesChanged();
}

void PileSolver::step(std::span<Body> bodies, Mover& mover, double t, double dt, double end,
                      const Event& stamp, std::vector<Event>& events) {
  if (!(dt > 0.0 && std::isfinite(dt))) return;
  const double h = dt / substeps_;
  slots_.gather(bodies, dt, substeps_);
  // Impulses are those of a part, so they go with its length.
  contacts_.find(bodies, slots_, dt, lastPart_ > 0.0 ? std::min(h / lastPart_, 1.0) : 0.0);
  lastPart_ = h;
  const bool uniform = slots_.uniform();
  active_.reserve(slots_.size() + std::size_t{1});
  active_.resize(slots_.size() + std::size_t{1});
  free_.reserve(slots_.size());
  std::size_t active = 0;
  for (std::uint32_t slot = 0; slot < slots_.size();
       ++slot) { // without a branch: who touches cannot be foretold
    active_[active] = slot;
    const bool moves = slots_.weight(slot) > 0.0;
    active += static_cast<std::size_t>(moves & (!uniform | contacts_.touches(slot)));
  }
  active_.resize(active);
  free_.resize(active_.size());
  if (!uniform) motions_.resize(slots_.size());

  const Softness soft = softness(h);
  for (int part = 0; part < substeps_; ++part) {
    const double partEnd = part + 1 == substeps_ ? end : t + (part + 1) * h;
    if (uniform) {
      accelerateAlike(part == 0);
    } else {
      accelerate(bodies, mover, part == 0, t + part * h, h, partEnd);
    }
    if (part == 0) contacts_.warmStart(slots_.states());
    for (int i = 0; i < iterations_; ++i) contacts_.solve(slots_.states(), h, soft);
    if (uniform) {
      advanceAlike(h);
    } else {
      advance(bodies, h);
    }
    contacts_.relax(slots_.states(), h);
    if (!uniform) showVelocities(bodies);
  }
  contacts_.restitute(slots_.states());
  const std::size_t firstEvent = events.size();
  finish(bodies, h, stamp, events);
  contacts_.report(bodies, stamp, firstEvent, events);
  contacts_.remember(slots_);
}

// What contacts changed of a velocity in one part they will change again in the next: the sum of their warm
// impulses.

void PileSolver::accelerateAlike(bool first) {
  SlotState* const states = slots_.states().data();
  Two* const free = free_.data();
  const std::size_t count = active_.size();
  for (std::size_t i = 0; i < count; ++i) {
    SlotState& state = states[active_[i]];
    const Two v = load(&state.vx);
    const Two freely = v + load(slots_.gained(active_[i]).data());
    store(&state.vx, first ? freely : freely + (v - free[i]));
    free[i] = freely;
  }
}

void PileSolver::advanceAlike(double h) {
  SlotState* const states = slots_.states().data();
  for (const std::uint32_t slot : active_) {
    SlotState& state = states[slot];
    store(&state.x, load(&state.x) + load(&state.vx) * h);
  }
}

void PileSolver::accelerate(std::span<Body> bodies, Mover& mover, bool first, double t, double h,
                            double end) {
  mover.begin(bodies, t, h);
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const std::uint32_t slot = active_[i];
    SlotState& state = slots_.states()[slot];
    motions_[slot] = mover.next(bodies, slots_.bodyOf(slot), t, h, end);
    const Two freely = load(motions_[slot].velocity.data());
    store(&state.vx, first ? freely : freely + (load(&state.vx) - free_[i]));
    free_[i] = freely;
  }
}

void PileSolver::advance(std::span<Body> bodies, double h) {
  for (const std::uint32_t slot : active_) {
    // Where the integrator would have gone, and the contacts' part on top; without contacts to the bit.
    SlotState& state = slots_.states()[slot];
    const Motion& motion = motions_[slot];
    Body& body = bodies[slots_.bodyOf(slot)];
    const Vec2 v(state.vx, state.vy);
    body.position =
        v == motion.velocity ? motion.position : Vec2(motion.position + (v - motion.velocity) * h);
    const PairGrid::Point centre = PairGrid::centreOf(body);
    state.x = centre.x;
    state.y = centre.y;
  }
}

/// Forces of the next part see the velocities of this one.
void PileSolver::showVelocities(std::span<Body> bodies) {
  for (const std::uint32_t slot : active_) {
    const SlotState& state = slots_.states()[slot];
    bodies[slots_.bodyOf(slot)].velocity = Vec2(state.vx, state.vy);
  }
}

void PileSolver::finish(std::span<Body> bodies, double h, const Event& stamp, std::vector<Event>& events) {
  const std::uint32_t* const order = slots_.grid().order().data();
  const std::uint32_t size = slots_.size();
  const Two upper = load(pane_.data());
  PairGrid::Counting counting = slots_.countAtEnd();
  for (std::uint32_t slot = 0; slot < size; ++slot) {
    constexpr std::uint32_t kAhead = 24; // bodies lie scattered
    if (slot + kAhead < size) __builtin_prefetch(&bodies[order[slot + kAhead]], 1);
    const std::uint32_t index = order[slot];
    Body& body = bodies[index];
    if (slots_.weight(slot) > 0.0) {
      settle(body, slot, h);
      const Two half = slots_.half(slot) + Two{};
      const Two position = load(body.position.data());
      if ((maskOf(position > half) & maskOf(position < upper - half)) != 3)
        holdToWalls(body, slot, stamp, events); // no circle that is wholly inside
    }
    counting.add(index, PairGrid::centreOf(body));
  }
}

/// Gives a body that can move what its slot has come to.
inline void PileSolver::settle(Body& body, std::uint32_t slot, double h) {
  const SlotState& state = slots_.states()[slot];
  if (!slots_.uniform()) {
    body.velocity = Vec2(state.vx, state.vy);
    return;
  }
  // Who has had nothing to do with anybody is not in active_ and flies on from the step's start.
  Two velocity = load(body.velocity.data());
  Two position = load(body.position.data());
  const Two gained = load(slots_.gained(slot).data());
  for (int part = substeps_; part > 0; --part) {
    velocity = velocity + gained;
    position = position + velocity * h;
  }
  const auto touches = TwoBits{} - static_cast<std::int64_t>(contacts_.touches(slot));
  Two place = load(&state.x);
  if (body.shape == Shape::Rectangle) place = place - load(body.size.data()) * 0.5;
  store(body.velocity.data(), select(touches, load(&state.vx), velocity));
  store(body.position.data(), select(touches, place, position));
}

void PileSolver::holdToWalls(Body& body, std::uint32_t slot, const Event& stamp,
                             std::vector<Event>& events) const {
  for (std::uint32_t side = 0; side < 4; ++side) {
    const std::optional<double>& multiplier = walls_.restitution[side];
    if (!multiplier) continue;
    const int axis = side < 2 ? 0 : 1;
    const bool lower = side % 2 == 0;
    double& x = body.position[axis];
    double& v = body.velocity[axis];
    const Reach reach = reachOf(body, axis);
    const double edge = lower ? reach.before : pane_[axis] - reach.after;
    if (!(lower ? x < edge : x > edge)) continue;
    const double closing = lower ? -v : v;
    if (slots_.counts(closing, slot)) {
      events.push_back(wallEvent(stamp, side, body.id, x, v));
      v = -v * (*multiplier * body.restitution);
    } else if (closing > 0.0) {
      v = 0.0;
    }
    x = edge;
  }
}

} // namespace offstage
