#include "src/sim/pile_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

namespace offstage {
namespace {

/// Bodies that are not further apart than this share of the smaller one's half extent are in contact before
/// they touch, so that they meet within the step; those that close in faster up to kMargin.
constexpr double kSlack = 0.1;
constexpr double kMargin = 0.25;

/// Catto's soft contact for parts of length h; rates are in 1/h, and pi is written out so that no library
/// has a say in its bits.
Softness softness(double h) {
  constexpr double kDampingRatio = 10.0;
  constexpr double kOmega = 2.0 * 3.14159265358979323846 * 0.25; // times h: a quarter of the parts' rate
  constexpr double kA1 = 2.0 * kDampingRatio + kOmega;
  constexpr double kA2 = kOmega * kA1;
  constexpr double kA3 = 1.0 / (1.0 + kA2);
  return {kOmega / kA1 / h, kA2 * kA3, kA3};
}

Vec2 ownAcceleration(const Body& body, const Vec2& gravity) {
  return (body.feelsGravity ? gravity : Vec2::Zero()) + body.acceleration;
}

/// The smaller half extent.
double thinness(const Body& body) {
  return body.shape == Shape::Circle ? body.radius : 0.5 * std::min(body.size.x(), body.size.y());
}

/// How far a body reaches from its position: a circle by its radius both ways, a rectangle by its size one
/// way.
double reachBefore(const Body& body) {
  return body.shape == Shape::Circle ? body.radius : 0.0;
}
double reachAfter(const Body& body, int axis) {
  return body.shape == Shape::Circle ? body.radius : body.size[axis];
}

std::uint32_t sideOf(const PileContact& wall) {
  if (wall.nx != 0.0) return wall.nx < 0.0 ? 0 : 1;
  return wall.ny < 0.0 ? 2 : 3;
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

} // namespace

PileSolver::PileSolver(const WorldSetup& setup)
    : gravity_(setup.gravity),
      pane_(setup.pane),
      walls_(setup.walls),
      substeps_(setup.substeps),
      iterations_(setup.iterations),
      forces_(!setup.forces.empty()) {
  std::vector<ContactRule> bounces;
  for (const ContactRule& rule : setup.contacts) {
    if (rule.response == Response::Bounce) bounces.push_back(rule);
  }
  rules_ = RuleTable(bounces);
}

void PileSolver::keepOnly(std::span<const std::uint8_t> removed) {
  memory_.keepOnly(removed);
  sizesChanged_ = true;
}

void PileSolver::step(std::span<Body> bodies, Mover& mover, double t, double dt, double end,
                      const Event& stamp, std::vector<Event>& events) {
  if (!(dt > 0.0 && std::isfinite(dt))) return;
  const double h = dt / substeps_;
  // Impulses are those of a part, so they go with its length.
  warmth_ = lastPart_ > 0.0 ? std::min(h / lastPart_, 1.0) : 0.0;
  learnBodies(bodies);
  gather(bodies, h);
  grid_.forEachPair([&](std::uint32_t a, std::uint32_t b) {
    const PairGrid::Place& first = grid_.place(a);
    const PairGrid::Place& second = grid_.place(b);
    if (first.half < 0.0 || second.half < 0.0) {
      considerShapes(bodies, a, b, dt);
      return;
    }
    const double dx = second.x - first.x;
    const double dy = second.y - first.y;
    const double far = first.half + second.half + kMargin * std::min(first.half, second.half);
    if (dx * dx + dy * dy < far * far) considerCircles(bodies, a, b, dt);
  });
  active_.clear();
  for (std::uint32_t slot = 0; slot < bodies.size(); ++slot) {
    considerWalls(bodies, slot, dt);
    if (weights_[slot] > 0.0 && (!uniform_ || blocks_.touches(slot))) active_.push_back(slot);
  }

  for (int part = 0; part < substeps_; ++part) {
    const double partEnd = part + 1 == substeps_ ? end : t + (part + 1) * h;
    accelerate(bodies, mover, part == 0, t + part * h, h, partEnd);
    if (part == 0) warmStart();
    solveAll(h);
    advance(bodies, h);
    relaxAll(bodies, h);
  }
  restitute();
  const std::size_t firstEvent = events.size();
  finish(bodies, h, stamp, events);
  report(bodies, stamp, firstEvent, events);
  remember(bodies.size());
  lastPart_ = h;
}

void PileSolver::learnBodies(std::span<const Body> bodies) {
  if (paired_.size() != bodies.size()) sizesChanged_ = true;
  if (!sizesChanged_) return;
  paired_.clear();
  uniform_ = !forces_;
  plain_ = true;
  for (const Body& body : bodies) {
    paired_.push_back(rules_.numberOf(body.group) != RuleTable::kNoRule ? 1 : 0);
    uniform_ = uniform_ && (body.fixed || body.integrator == Integrator::SemiImplicitEuler);
    plain_ = plain_ && body.restitution == 1.0 && body.friction == 0.0;
  }
}

void PileSolver::gather(std::span<const Body> bodies, double h) {
  grid_.begin(bodies, paired_, kMargin, sizesChanged_);
  sizesChanged_ = false;
  const std::size_t slots = bodies.size();
  states_.resize(slots + 2);
  weights_.resize(slots + 1);
  gained_.resize(slots);
  free_.resize(slots);
  if (rules_.groups() > 1) groups_.resize(slots);
  if (!uniform_) {
    motions_.resize(slots);
    starts_.resize(slots);
  }
  for (std::uint32_t i = 0; i < slots; ++i) {
    const Body& body = bodies[i];
    const std::uint32_t slot = grid_.insert(i, body);
    if (!uniform_) starts_[slot] = body.position;
    if (rules_.groups() > 1) groups_[slot] = rules_.numberOf(body.group);
    if (body.fixed) {
      states_[slot] = {};
      weights_[slot] = 0.0;
      gained_[slot] = Vec2::Zero();
    } else {
      states_[slot] = {body.velocity.x(), body.velocity.y(), 0.0, 0.0};
      weights_[slot] = 1.0 / body.mass;
      gained_[slot] = ownAcceleration(body, gravity_) * h;
    }
  }
  grid_.end();
  states_[slots] = states_[slots + 1] = {}; // the outside, and nobody
  weights_[slots] = 0.0;
  blocks_.begin(slots + 1);
  rubbings_.clear();
  impacts_.clear();
}

bool PileSolver::counts(double closing, std::uint32_t slot) const {
  const double steps = kRestingSteps * substeps_;
  return closing > 0.0 && closing * closing > steps * steps * dot(gained_[slot], gained_[slot]);
}

void PileSolver::considerCircles(std::span<const Body> bodies, std::uint32_t a, std::uint32_t b, double dt) {
  const PairGrid::Place& first = grid_.place(a);
  const PairGrid::Place& second = grid_.place(b);
  const double dx = second.x - first.x;
  const double dy = second.y - first.y;
  const double distance = std::sqrt(dx * dx + dy * dy);
  const bool apart = distance > 0.0;
  const double nx = apart ? dx / distance : 1.0;
  const double ny = apart ? dy / distance : 0.0;
  const SlotState& v1 = states_[a];
  const SlotState& v2 = states_[b];
  const double closing = (v1.vx - v2.vx) * nx + (v1.vy - v2.vy) * ny;
  const double gap = distance - (first.half + second.half);
  if (gap - std::max(closing, 0.0) * dt > kSlack * std::min(first.half, second.half)) return;
  PileContact contact{a, b, nx, ny, gap, 0.0, 0.0};
  addPair(bodies, contact, closing, distance);
}

void PileSolver::considerShapes(std::span<const Body> bodies, std::uint32_t a, std::uint32_t b, double dt) {
  const Body& first = bodies[grid_.order()[a]];
  const Body& second = bodies[grid_.order()[b]];
  // A thin floor is as good as a thick one.
  const double smaller = first.fixed    ? thinness(second)
                         : second.fixed ? thinness(first)
                                        : std::min(thinness(first), thinness(second));
  const auto contact = findContact(first, second, kMargin * smaller);
  if (!contact) return;
  const double closing = closingSpeed(*contact, first, second);
  const double gap = contact->distance - contact->touch;
  if (gap - std::max(closing, 0.0) * dt > kSlack * smaller) return;
  PileContact pair{a, b, contact->normal.x(), contact->normal.y(), gap, 0.0, 0.0};
  addPair(bodies, pair, closing, contact->distance);
}

void PileSolver::addPair(std::span<const Body> bodies, PileContact& contact, double closing,
                         double distance) {
  const double weight = weights_[contact.a] + weights_[contact.b];
  if (!(weight > 0.0)) return; // both fixed
  const ContactRule* rule =
      rules_.groups() == 1 ? rules_.find(0, 0) : rules_.find(groups_[contact.a], groups_[contact.b]);
  if (rule == nullptr) return;
  contact.share = weights_[contact.a] / weight;
  const std::uint32_t i = grid_.order()[contact.a];
  const std::uint32_t j = grid_.order()[contact.b];
  Meeting meeting{closing, counts(closing, contact.a) && counts(closing, contact.b), rule->restitution,
                  distance};
  double friction = 0.0;
  if (!plain_) {
    meeting.restitution *= pairOf(bodies[i].restitution, bodies[j].restitution);
    friction = pairOf(bodies[i].friction, bodies[j].friction);
  }
  addContact(contact, std::min(i, j), std::max(i, j), meeting, friction);
}

void PileSolver::considerWalls(std::span<const Body> bodies, std::uint32_t slot, double dt) {
  const PairGrid::Place& place = grid_.place(slot);
  const SlotState& state = states_[slot];
  const Vec2 gained = gained_[slot] * substeps_;
  const double half = std::abs(place.half);
  const double farX = half * (1.0 + kSlack) + (std::abs(state.vx) + std::abs(gained.x())) * dt;
  const double farY = half * (1.0 + kSlack) + (std::abs(state.vy) + std::abs(gained.y())) * dt;
  if (place.x > farX && place.x < pane_.x() - farX && place.y > farY && place.y < pane_.y() - farY) return;
  if (!(weights_[slot] > 0.0)) return;
  const Body& body = bodies[grid_.order()[slot]];
  for (std::uint32_t side = 0; side < 4; ++side) {
    const std::optional<double>& multiplier = walls_.restitution[side];
    if (!multiplier) continue;
    const int axis = side < 2 ? 0 : 1;
    const bool lower = side % 2 == 0;
    const double x = body.position[axis];
    const double gap = lower ? x - reachBefore(body) : pane_[axis] - (x + reachAfter(body, axis));
    const double sign = lower ? -1.0 : 1.0; // of the way out
    const double closing = sign * body.velocity[axis];
    const double reach = std::max(closing + std::max(sign * gained[axis], 0.0), 0.0) * dt;
    if (!(gap - reach <= kSlack * thinness(body))) continue;
    const auto outside = static_cast<std::uint32_t>(weights_.size() - 1);
    PileContact contact{slot, outside, axis == 0 ? sign : 0.0, axis == 1 ? sign : 0.0, gap, 1.0, 0.0};
    addContact(contact, grid_.order()[slot], ContactMemory::kFirstWall + side,
               {closing, counts(closing, slot), *multiplier * body.restitution, x}, body.friction);
  }
}

void PileSolver::addContact(PileContact& contact, std::uint32_t body, std::uint32_t other,
                            const Meeting& meeting, double friction) {
  const ContactMemory::Entry* before = memory_.find(body, other);
  if (before != nullptr) contact.impulse = warmth_ * static_cast<double>(before->impulse);
  const ContactBlocks::Place place = blocks_.add(contact);
  if (friction > 0.0) {
    const double rubbing = before != nullptr ? warmth_ * static_cast<double>(before->rubbing) : 0.0;
    rubbings_.push_back({place, contact, friction, rubbing, body, other});
  }
  if (meeting.counts) impacts_.push_back({place, contact, meeting, body, other, before == nullptr, false});
}

void PileSolver::accelerate(std::span<Body> bodies, Mover& mover, bool first, double t, double h,
                            double end) {
  if (!uniform_) mover.begin(bodies, t, h);
  for (const std::uint32_t slot : active_) {
    SlotState& state = states_[slot];
    const Vec2 v(state.vx, state.vy);
    Vec2 freely;
    if (uniform_) {
      freely = v + gained_[slot];
    } else {
      motions_[slot] = mover.next(bodies, grid_.order()[slot], t, h, end);
      freely = motions_[slot].velocity;
    }
    // What contacts changed in the part before they will change again: the sum of their warm impulses.
    const Vec2 warm = first ? freely : Vec2(freely + (v - free_[slot]));
    free_[slot] = freely;
    state.vx = warm.x();
    state.vy = warm.y();
  }
}

/// Changes the velocities of a contact's bodies by `speed` along (x, y), as they share it.
void PileSolver::change(const PileContact& contact, double x, double y, double speed) {
  const double ofA = contact.share * speed;
  const double ofB = speed - ofA;
  SlotState& a = states_[contact.a];
  SlotState& b = states_[contact.b];
  a.vx -= ofA * x;
  a.vy -= ofA * y;
  b.vx += ofB * x;
  b.vy += ofB * y;
}

void PileSolver::warmStart() {
  blocks_.warmStart(states_);
  for (const Rubbing& rubbing : rubbings_) {
    change(rubbing.contact, -rubbing.contact.ny, rubbing.contact.nx, rubbing.impulse);
  }
}

void PileSolver::solveAll(double h) {
  const Softness soft = softness(h);
  for (int i = 0; i < iterations_; ++i) {
    blocks_.solve(states_, h, soft);
    rub();
  }
}

void PileSolver::rub() {
  for (Rubbing& rubbing : rubbings_) {
    const PileContact& c = rubbing.contact;
    const SlotState& a = states_[c.a];
    const SlotState& b = states_[c.b];
    const double slip = (b.vy - a.vy) * c.nx - (b.vx - a.vx) * c.ny; // along (−ny, nx)
    const double most = rubbing.friction * blocks_.impulse(rubbing.place);
    const double impulse = std::clamp(rubbing.impulse - slip, -most, most);
    change(c, -c.ny, c.nx, impulse - rubbing.impulse);
    rubbing.impulse = impulse;
  }
}

void PileSolver::advance(std::span<Body> bodies, double h) {
  for (const std::uint32_t slot : active_) {
    SlotState& state = states_[slot];
    if (uniform_) {
      state.dx += state.vx * h;
      state.dy += state.vy * h;
      continue;
    }
    // Where the integrator would have gone, and the contacts' part on top; without contacts to the bit.
    const Motion& motion = motions_[slot];
    Body& body = bodies[grid_.order()[slot]];
    const Vec2 v(state.vx, state.vy);
    body.position =
        v == motion.velocity ? motion.position : Vec2(motion.position + (v - motion.velocity) * h);
    const Vec2 moved = body.position - starts_[slot];
    state.dx = moved.x();
    state.dy = moved.y();
  }
}

void PileSolver::relaxAll(std::span<Body> bodies, double h) {
  const auto markTouched = [&] {
    for (Impact& impact : impacts_) impact.touched = impact.touched || blocks_.impulse(impact.place) > 0.0;
  };
  markTouched(); // before and after: a contact may end here, and one that was just reached begins here
  blocks_.relax(states_, h);
  rub();
  markTouched();
  if (uniform_) return;
  for (const std::uint32_t slot : active_) {
    bodies[grid_.order()[slot]].velocity = Vec2(states_[slot].vx, states_[slot].vy);
  }
}

void PileSolver::restitute() {
  for (const Impact& impact : impacts_) {
    if (!impact.touched || !(impact.meeting.restitution > 0.0)) continue;
    const PileContact& c = impact.contact;
    const SlotState& a = states_[c.a];
    const SlotState& b = states_[c.b];
    const double parting = (b.vx - a.vx) * c.nx + (b.vy - a.vy) * c.ny;
    const double missing = impact.meeting.restitution * impact.meeting.closing - parting;
    if (missing > 0.0) change(c, c.nx, c.ny, missing);
    blocks_.setImpulse(impact.place, 0.0); // they part: there is nothing to start from
  }
}

void PileSolver::finish(std::span<Body> bodies, double h, const Event& stamp, std::vector<Event>& events) {
  for (std::uint32_t slot = 0; slot < bodies.size(); ++slot) {
    if (!(weights_[slot] > 0.0)) continue;
    Body& body = bodies[grid_.order()[slot]];
    const SlotState& state = states_[slot];
    if (uniform_ && !blocks_.touches(slot)) { // it has had nothing to do with anybody
      for (int part = 0; part < substeps_; ++part) {
        body.velocity = body.velocity + gained_[slot];
        body.position = body.position + body.velocity * h;
      }
    } else {
      body.velocity = Vec2(state.vx, state.vy);
      if (uniform_) body.position += Vec2(state.dx, state.dy);
    }
    const double half = grid_.place(slot).half;
    const Vec2& p = body.position;
    if (half >= 0.0 && p.x() > half && p.x() < pane_.x() - half && p.y() > half && p.y() < pane_.y() - half) {
      continue; // a circle wholly inside
    }
    holdToWalls(body, slot, stamp, events);
  }
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
    const double edge = lower ? reachBefore(body) : pane_[axis] - reachAfter(body, axis);
    if (!(lower ? x < edge : x > edge)) continue;
    const double closing = lower ? -v : v;
    if (counts(closing, slot)) {
      events.push_back(wallEvent(stamp, side, body.id, x, v));
      v = -v * (*multiplier * body.restitution);
    } else if (closing > 0.0) {
      v = 0.0;
    }
    x = edge;
  }
}

void PileSolver::report(std::span<const Body> bodies, const Event& stamp, std::size_t firstEvent,
                        std::vector<Event>& events) const {
  for (const Impact& impact : impacts_) {
    if (!impact.touched || !impact.isNew) continue;
    if (impact.other >= ContactMemory::kFirstWall) {
      const std::uint32_t side = impact.other - ContactMemory::kFirstWall;
      const double v = side % 2 == 0 ? -impact.meeting.closing : impact.meeting.closing;
      events.push_back(wallEvent(stamp, side, bodies[impact.body].id, impact.meeting.p, v));
    } else {
      Event event = stamp;
      event.kind = EventKind::Collide;
      event.first = bodies[impact.body].id;
      event.second = bodies[impact.other].id;
      event.p = impact.meeting.p;
      event.q = impact.meeting.closing;
      events.push_back(event);
    }
  }
  // The grid's order means nothing to a reader.
  std::sort(events.begin() + static_cast<std::ptrdiff_t>(firstEvent), events.end(),
            [](const Event& a, const Event& b) {
              return std::tie(a.first, a.second, a.kind) < std::tie(b.first, b.second, b.kind);
            });
}

void PileSolver::remember(std::size_t bodies) {
  const auto outside = static_cast<std::uint32_t>(bodies);
  const auto order = grid_.order();
  memory_.remember(bodies, [&](auto&& visit) {
    blocks_.forEach([&](const PileContact& contact) {
      if (!(contact.impulse > 0.0)) return;
      const auto impulse = static_cast<float>(contact.impulse);
      const std::uint32_t i = order[contact.a];
      if (contact.b == outside) {
        visit(i, ContactMemory::Entry{ContactMemory::kFirstWall + sideOf(contact), impulse, 0.0F});
      } else {
        const std::uint32_t j = order[contact.b];
        visit(std::min(i, j), ContactMemory::Entry{std::max(i, j), impulse, 0.0F});
      }
    });
  });
  for (const Rubbing& rubbing : rubbings_) {
    if (ContactMemory::Entry* entry = memory_.find(rubbing.body, rubbing.other)) {
      entry->rubbing = static_cast<float>(rubbing.impulse);
    }
  }
}

} // namespace offstage
