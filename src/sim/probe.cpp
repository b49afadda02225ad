#include "src/sim/probe.h"

#include "src/sim/birth.h"
#include "src/sim/force_field.h"
#include "src/sim/world.h"

#include <cmath>
#include <limits>

namespace offstage {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The sums over a system that all of its quantities come from.
struct System {
  double mass = 0.0;
  Vec2 weighted = Vec2::Zero(); ///< mass·px: masses times centres
  Vec2 momentum = Vec2::Zero();
  double kinetic = 0.0;
  double potential = 0.0;
  double count = 0.0;
};

void add(System& system, const Body& body, const Snapshot& snapshot, bool energies) {
  system.count += 1.0;
  if (body.fixed) return;
  system.mass += body.mass;
  system.weighted += centre(body, body.position) * body.mass;
  system.momentum += body.velocity * body.mass;
  system.kinetic += 0.5 * body.mass * dot(body.velocity, body.velocity);
  if (energies) system.potential += potentialEnergy(body, snapshot);
}

double quantityOf(Quantity quantity, const System& system) {
  switch (quantity) {
  case Quantity::X:
    return system.weighted.x() / system.mass;
  case Quantity::Y:
    return system.weighted.y() / system.mass;
  case Quantity::Vx:
    return system.momentum.x() / system.mass;
  case Quantity::Vy:
    return system.momentum.y() / system.mass;
  case Quantity::Speed:
    return length(system.momentum) / system.mass;
  case Quantity::Px:
    return system.momentum.x();
  case Quantity::Py:
    return system.momentum.y();
  case Quantity::Momentum:
    return length(system.momentum);
  case Quantity::Kinetic:
    return system.kinetic;
  case Quantity::Potential:
    return system.potential;
  case Quantity::Energy:
    return system.kinetic + system.potential;
  case Quantity::Count:
    return system.count;
  case Quantity::Error:
  case Quantity::Time:
  case Quantity::Frame:
    break;
  }
  return kNone;
}

/// Of one body: what `trace` tells of it comes out with the same bits.
double quantityOf(const Probe& probe, const Body* body, const Snapshot& snapshot) {
  if (body == nullptr) return probe.quantity == Quantity::Count ? 0.0 : kNone;
  switch (probe.quantity) {
  case Quantity::X:
    return body->position.x();
  case Quantity::Y:
    return body->position.y();
  case Quantity::Vx:
    return body->velocity.x();
  case Quantity::Vy:
    return body->velocity.y();
  case Quantity::Speed:
    return length(body->velocity);
  case Quantity::Error: {
    const Body* other = findBody(snapshot.bodies, probe.other);
    return other == nullptr ? kNone : length(body->position - other->position);
  }
  default:
    break;
  }
  System alone;
  add(alone, *body, snapshot, true);
  return quantityOf(probe.quantity, alone);
}

double rawValue(const Probe& probe, const Snapshot& snapshot) {
  if (probe.quantity == Quantity::Time) return snapshot.time;
  if (probe.quantity == Quantity::Frame) return static_cast<double>(snapshot.frame);
  if (probe.body) return quantityOf(probe, findBody(snapshot.bodies, *probe.body), snapshot);
  const bool energies = probe.quantity == Quantity::Potential || probe.quantity == Quantity::Energy;
  System system;
  for (const Body& body : snapshot.bodies) {
    if (!probe.group || *probe.group == body.group) add(system, body, snapshot, energies);
  }
  return quantityOf(probe.quantity, system);
}

/// From the point that a force pulls to; nothing when it pulls to a body that is gone, or to this very one.
std::optional<Vec2> fromAnchor(const Anchor& anchor, const Body& body, const Vec2& at,
                               const Snapshot& snapshot) {
  if (!anchor.body) return Vec2(at - anchor.point);
  const Body* tied = *anchor.body == body.id ? nullptr : findBody(snapshot.bodies, *anchor.body);
  if (tied == nullptr) return std::nullopt;
  return Vec2(at - centre(*tied, tied->position));
}

double potentialOf(const Force& force, const Body& body, const Vec2& at, const Snapshot& snapshot) {
  if (const auto* spring = std::get_if<SpringForce>(&force.kind)) {
    const auto d = fromAnchor(spring->to, body, at, snapshot);
    if (!d) return 0.0;
    const double stretched = length(*d) - spring->length;
    return 0.5 * spring->stiffness * (stretched * stretched);
  }
  if (const auto* attract = std::get_if<AttractForce>(&force.kind)) {
    const auto d = fromAnchor(attract->to, body, at, snapshot);
    if (!d) return 0.0;
    const double r = std::sqrt(dot(*d, *d) + attract->softening * attract->softening);
    return -(attract->strength * body.mass) / r;
  }
  return 0.0;
}

} // namespace

Snapshot snapshotOf(const World& world) {
  const WorldSetup& setup = world.setup();
  return {world.frame(), world.time(), world.bodies(), setup.pane.y(), setup.gravity, setup.forces};
}

double potentialEnergy(const Body& body, const Snapshot& snapshot) {
  const Vec2 at = centre(body, body.position);
  const Vec2 uniform = (body.feelsGravity ? snapshot.gravity : Vec2::Zero()) + body.acceleration;
  double energy = body.mass * (uniform.y() * (snapshot.paneHeight - at.y()) - uniform.x() * at.x());
  for (const Force& force : snapshot.forces) {
    if (actsOn(force, body)) energy += potentialOf(force, body, at, snapshot);
  }
  return energy;
}

double potentialEnergy(const Force& force, const Body& body, const Snapshot& snapshot) {
  return actsOn(force, body) ? potentialOf(force, body, centre(body, body.position), snapshot) : 0.0;
}

double valueOf(const Probe& probe, const Snapshot& snapshot) {
  return (rawValue(probe, snapshot) - probe.zero) / probe.unit;
}

} // namespace offstage
