#include "src/sim/pile_slots.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace offstage {
namespace {

/// See PileSlots::half().
double halfOf(const Body& body) {
  return body.shape == Shape::Circle ? body.radius : std::numeric_limits<double>::infinity();
}

Vec2 ownAcceleration(const Body& body, const Vec2& gravity) {
  return (body.feelsGravity ? gravity : Vec2::Zero()) + body.acceleration;
}

} // namespace

PileSlots::PileSlots(const WorldSetup& setup, const RuleTable& rules)
    : pane_(setup.pane), gravity_(setup.gravity), forces_(!setup.forces.empty()), rules_(rules) {}

void PileSlots::learn(std::span<const Body> bodies) {
  paired_.clear();
  paired_.reserve(bodies.size());
  uniform_ = !forces_;
  plain_ = sameGain_ = sameWeight_ = sameHalf_ = true;
  half_ = bodies.empty() ? 0.0 : halfOf(bodies.front());
  const Body* some = nullptr;
  for (const Body& body : bodies) {
    paired_.push_back(rules_.numberOf(body.group) != RuleTable::kNoRule ? 1 : 0);
    plain_ = plain_ && body.restitution == 1.0 && body.friction == 0.0;
    sameHalf_ = sameHalf_ && body.shape == Shape::Circle && body.radius == half_;
    if (body.fixed) sameWeight_ = false;
    if (body.fixed) continue;
    uniform_ = uniform_ && body.integrator == Integrator::SemiImplicitEuler;
    if (some == nullptr) some = &body;
    sameGain_ = sameGain_ && ownAcceleration(body, gravity_) == ownAcceleration(*some, gravity_);
    sameWeight_ = sameWeight_ && body.mass == some->mass;
  }
  someMoving_ = some == nullptr ? 0 : static_cast<std::uint32_t>(some - bodies.data());
}

/// Whether a slot that can move is so near an edge that it may touch it within the step.
inline bool PileSlots::mayReachEdge(std::uint32_t slot, double dt) const {
  const SlotState& state = states_[slot];
  const Vec2 gained = gainedInStep(slot);
  const double wide = half(slot) * (1.0 + kSlack);
  const double farX = wide + (std::abs(state.vx) + std::abs(gained.x())) * dt;
  const double farY = wide + (std::abs(state.vy) + std::abs(gained.y())) * dt;
  return !(state.x > farX && state.x < pane_.x() - farX && state.y > farY && state.y < pane_.y() - farY);
}

void PileSlots::gather(std::span<const Body> bodies, double dt, int parts) {
  const double h = dt / parts;
  parts_ = parts;
  restingSquared_ = (kRestingSteps * parts_) * (kRestingSteps * parts_);
  const bool changed = changed_ || paired_.size() != bodies.size();
  if (changed) {
    learn(bodies);
    grid_.layOut(bodies, paired_, kMargin);
  }
  if (changed || !counted_) {
    PairGrid::Counting counting = grid_.startCounting();
    for (std::uint32_t i = 0; i < bodies.size(); ++i) counting.add(i, PairGrid::centreOf(bodies[i]));
  }
  grid_.startInserting();
  changed_ = counted_ = false;

  size_ = static_cast<std::uint32_t>(bodies.size());
  states_.resize(size_ + std::size_t{kSpare});
  halves_.resize(sameHalf_ ? 0 : size_ + std::size_t{kSpare});
  weights_.resize(sameWeight_ ? 0 : size_);
  gained_.resize(sameGain_ ? std::size_t{1} : size_ + std::size_t{1});
  const bool grouped = rules_.groups() > 1;
  if (grouped) groups_.resize(size_);
  weight_ = 0.0;
  Vec2 gained = Vec2::Zero();
  if (someMoving_ < size_) {
    weight_ = 1.0 / bodies[someMoving_].mass;
    gained = ownAcceleration(bodies[someMoving_], gravity_) * h;
  }
  gained_[0] = gained;
  restingGain_ = restingSquared_ * dot(gained, gained);
  atEdges_.clear();
  for (std::uint32_t i = 0; i < size_; ++i) {
    const Body& body = bodies[i];
    const std::uint32_t slot = grid_.insert(i);
    const PairGrid::Point centre = PairGrid::centreOf(body);
    if (!sameHalf_) halves_[slot] = halfOf(body);
    if (grouped) groups_[slot] = rules_.numberOf(body.group);
    if (body.fixed) {
      states_[slot] = {0.0, 0.0, centre.x, centre.y};
      weights_[slot] = 0.0;
    } else {
      states_[slot] = {body.velocity.x(), body.velocity.y(), centre.x, centre.y};
      if (!sameWeight_) weights_[slot] = 1.0 / body.mass;
    }
    if (!sameGain_) gained_[slot] = body.fixed ? Vec2::Zero() : Vec2(ownAcceleration(body, gravity_) * h);
    if (!body.fixed && mayReachEdge(slot, dt)) atEdges_.push_back(slot);
  }
  grid_.end();
  std::fill(states_.begin() + size_, states_.end(), SlotState{});
}

} // namespace offstage
