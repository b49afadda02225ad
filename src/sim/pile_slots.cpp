#include "src/sim/pile_slots.h"

#include <limits>

namespace offstage {
namespace {

Vec2 ownAcceleration(const Body& body, const Vec2& gravity) {
  return (body.feelsGravity ? gravity : Vec2::Zero()) + body.acceleration;
}

} // namespace

PileSlots::PileSlots(const WorldSetup& setup, const RuleTable& rules)
    : gravity_(setup.gravity), forces_(!setup.forces.empty()), rules_(rules) {}

void PileSlots::learn(std::span<const Body> bodies) {
  paired_.clear();
  paired_.reserve(bodies.size());
  uniform_ = !forces_;
  plain_ = sameGain_ = sameWeight_ = true;
  const Body* some = nullptr;
  for (const Body& body : bodies) {
    paired_.push_back(rules_.numberOf(body.group) != RuleTable::kNoRule ? 1 : 0);
    plain_ = plain_ && body.restitution == 1.0 && body.friction == 0.0;
    if (body.fixed) sameWeight_ = false;
    if (body.fixed) continue;
    uniform_ = uniform_ && body.integrator == Integrator::SemiImplicitEuler;
    if (some == nullptr) some = &body;
    sameGain_ = sameGain_ && ownAcceleration(body, gravity_) == ownAcceleration(*some, gravity_);
    sameWeight_ = sameWeight_ && body.mass == some->mass;
  }
  someMoving_ = some == nullptr ? 0 : static_cast<std::uint32_t>(some - bodies.data());
}

void PileSlots::gather(std::span<const Body> bodies, double h, int parts) {
  parts_ = parts;
  restingSquared_ = (kRestingSteps * parts_) * (kRestingSteps * parts_);
  const bool changed = changed_ || paired_.size() != bodies.size();
  if (changed) learn(bodies);
  grid_.begin(bodies, paired_, kMargin, changed);
  changed_ = false;

  size_ = static_cast<std::uint32_t>(bodies.size());
  states_.resize(size_ + std::size_t{2});
  halves_.resize(size_ + std::size_t{1});
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
  for (std::uint32_t i = 0; i < size_; ++i) {
    const Body& body = bodies[i];
    const std::uint32_t slot = grid_.insert(i);
    const PairGrid::Point centre = PairGrid::centreOf(body);
    halves_[slot] = body.shape == Shape::Circle ? body.radius : std::numeric_limits<double>::infinity();
    if (grouped) groups_[slot] = rules_.numberOf(body.group);
    if (body.fixed) {
      states_[slot] = {0.0, 0.0, centre.x, centre.y};
      weights_[slot] = 0.0;
    } else {
      states_[slot] = {body.velocity.x(), body.velocity.y(), centre.x, centre.y};
      if (!sameWeight_) weights_[slot] = 1.0 / body.mass;
    }
    if (!sameGain_) gained_[slot] = body.fixed ? Vec2::Zero() : Vec2(ownAcceleration(body, gravity_) * h);
  }
  grid_.end();
  states_[size_] = states_[size_ + std::size_t{1}] = {};
}

} // namespace offstage
