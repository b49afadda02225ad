#include "src/sim/energy_watch.h"

#include "src/sim/world.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace offstage {
namespace {

constexpr double kLeastSpeed = 1.0; // px/s

/// A force that may do any work.
bool drives(const Force& force, std::span<const Body> bodies) {
  if (std::holds_alternative<WindForce>(force.kind) || std::holds_alternative<CustomForce>(force.kind))
    return true;
  if (!std::holds_alternative<AttractForce>(force.kind)) return false;
  const std::optional<std::uint32_t> anchor = anchorBody(force);
  return anchor && !(*anchor < bodies.size() && bodies[*anchor].fixed);
}

double kinetic(const Body& body) {
  return body.fixed ? 0.0 : 0.5 * body.mass * dot(body.velocity, body.velocity);
}

} // namespace

EnergyWatch::EnergyWatch(const WorldSetup& setup, std::span<const Body> bodies) {
  WorldSetup driving;
  driving.gravity = Vec2::Zero();
  for (const Force& force : setup.forces) {
    (drives(force, bodies) ? driving.forces : keeping_).push_back(force);
    causes_.attract = causes_.attract || std::holds_alternative<AttractForce>(force.kind);
  }
  isDriven_ = !driving.forces.empty();
  driving_ = ForceField(driving);
  for (const ContactRule& rule : setup.contacts)
    if (rule.response == Response::Slide) slides_.push_back(rule);
  for (const auto& edge : setup.walls.restitution) causes_.walls = causes_.walls || (edge && *edge > 1.0);
}

Vec2 EnergyWatch::drivenBy(const World& world, std::size_t index) const {
  const Body& body = world.bodies()[index];
  if (body.fixed) return Vec2::Zero();
  return driving_.acceleration(world.bodies(), index, {body.position, body.velocity}, world.time(),
                               everyone_) -
         body.acceleration;
}

/// Its part of what bodies have, by where it came to be and what pulls it there.
double EnergyWatch::boundOf(const Body& body, const Snapshot& snapshot, const Vec2& pane) {
  if (body.fixed) return 0.0;
  const Vec2 uniform = (body.feelsGravity ? snapshot.gravity : Vec2::Zero()) + body.acceleration;
  double bound = body.mass * dot(uniform.cwiseAbs(), pane);
  for (const Force& force : snapshot.forces)
    if (std::holds_alternative<AttractForce>(force.kind))
      bound += std::abs(potentialEnergy(force, body, snapshot));
  return bound;
}

/// A collision whose bodies are gone since counts as one, too.
bool EnergyWatch::isSlide(const World& world, const Event& event) const {
  if (event.kind != EventKind::Collide) return false;
  const Body* first = world.find(static_cast<std::uint32_t>(event.first));
  const Body* second = world.find(static_cast<std::uint32_t>(event.second));
  if (first == nullptr || second == nullptr) return true;
  return std::any_of(slides_.begin(), slides_.end(), [&](const ContactRule& rule) {
    return std::minmax(rule.groupA, rule.groupB) == std::minmax(first->group, second->group);
  });
}

std::optional<Warning> EnergyWatch::find(const World& world) {
  Snapshot snapshot = snapshotOf(world);
  snapshot.forces = keeping_;
  if (isDriven_ && driving_.couples()) {
    driving_.findAnchors(snapshot.bodies);
    everyone_.clear();
    for (const Body& body : snapshot.bodies) everyone_.push_back({body.position, body.velocity});
  }
  double change = 0.0; // of those that lived in the last frame, too
  double moving = 0.0; // kinetic, of stretched springs, and what driving forces could add to it
  double bound = 0.0;
  double mass = 0.0;
  const Body* fastest = nullptr;
  double most = 0.0;      // kinetic, of the fastest
  std::size_t before = 0; // in known_
  std::size_t stayed = 0;
  now_.clear();
  drivenNow_.clear();
  for (const Body& body : snapshot.bodies) { // both are in order of id
    const double motion = kinetic(body);
    Known known{.id = body.id, .energy = motion + potentialEnergy(body, snapshot)};
    if (isDriven_) drivenNow_.push_back({body.position, drivenBy(world, now_.size())});
    while (before < known_.size() && known_[before].id < body.id) ++before;
    if (before < known_.size() && known_[before].id == body.id) {
      change += known.energy - known_[before].energy;
      if (isDriven_) {
        const Driven& was = driven_[before];
        const Vec2 way = body.position - was.position;
        change -= 0.5 * body.mass * dot(was.acceleration + drivenNow_.back().acceleration, way);
      }
      known.bound = known_[before].bound;
      ++stayed;
    } else {
      known.bound = boundOf(body, snapshot, world.setup().pane);
      causes_.euler = causes_.euler || (!body.fixed && body.integrator == Integrator::ExplicitEuler);
    }
    now_.push_back(known);
    moving += motion;
    if (isDriven_) moving += body.mass * dot(drivenNow_.back().acceleration.cwiseAbs(), world.setup().pane);
    for (const Force& force : snapshot.forces)
      if (std::holds_alternative<SpringForce>(force.kind)) moving += potentialEnergy(force, body, snapshot);
    bound += known.bound;
    mass += body.mass;
    if (fastest == nullptr || motion > most) {
      fastest = &body;
      most = motion;
    }
  }
  const bool sameBodies = stayed == now_.size() && stayed == known_.size();
  const bool slid =
      !slides_.empty() && std::any_of(world.events().begin(), world.events().end(),
                                      [&](const Event& event) { return isSlide(world, event); });
  known_.swap(now_);
  driven_.swap(drivenNow_);
  sum_ += sameBodies && !slid ? change : std::min(change, 0.0);
  lowest_ = std::min(lowest_, sum_);
  const double gained = sum_ - lowest_;
  moving_ = std::max(moving_, moving - gained);
  const double usual = moving_ + bound + 0.5 * mass * (kLeastSpeed * kLeastSpeed);
  if (!(gained > (isDriven_ ? kMostDriven : kMost) * usual)) return std::nullopt;
  Warning warning;
  warning.body = fastest->id;
  warning.group = fastest->group;
  EnergyGrowth growth = causes_;
  growth.gained = gained;
  growth.usual = usual;
  warning.what = growth;
  return warning;
}

} // namespace offstage
