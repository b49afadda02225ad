#include "src/sim/force_field.h"

#include <algorithm>

namespace offstage {
namespace {

/// A point that a force pulls to, and its velocity.
struct Pull {
  Vec2 point;
  Vec2 velocity;
};

Vec2 springForce(const SpringForce& spring, const Vec2& position, const Vec2& velocity, const Pull& pull) {
  const Vec2 d = position - pull.point;
  if (spring.length == 0.0 && spring.damping == 0.0) return d * -spring.stiffness;
  const double distance = length(d);
  Vec2 force = spring.length == 0.0 ? Vec2(d * -spring.stiffness) : Vec2::Zero();
  if (!(distance > 0.0)) return force; // no direction in which it could push or damp
  const Vec2 direction = d / distance;
  if (spring.length != 0.0) force = direction * (-spring.stiffness * (distance - spring.length));
  return force - direction * (spring.damping * dot(velocity - pull.velocity, direction));
}

Vec2 attraction(const AttractForce& attract, const Vec2& position, const Vec2& point) {
  const Vec2 d = position - point;
  const double r = std::sqrt((d.x() * d.x() + d.y() * d.y()) + attract.softening * attract.softening);
  const double r3 = r * r * r;
  if (r3 == 0.0) return Vec2::Zero(); // at the centre there is no direction
  return {((-attract.strength) * d.x()) / r3, ((-attract.strength) * d.y()) / r3};
}

/// What all bodies but the one that a force is tied to feel of it, as an acceleration.
Vec2 accelerationBy(const Force& force, const Body& body, const Motion& motion, double time,
                    const Pull& pull) {
  const Vec2 position = centre(body, motion.position);
  const Vec2& v = motion.velocity;
  struct Visitor {
    const Body& body;
    const Vec2& position;
    const Vec2& v;
    double time;
    const Pull& pull;
    Vec2 operator()(const DragForce& drag) const {
      return (v * -drag.linear - v * (drag.quadratic * length(v))) / body.mass;
    }
    Vec2 operator()(const SpringForce& spring) const {
      return springForce(spring, position, v, pull) / body.mass;
    }
    Vec2 operator()(const AttractForce& attract) const { return attraction(attract, position, pull.point); }
    Vec2 operator()(const WindForce& wind) const {
      return ((wind.velocity - v) * wind.coefficient) / body.mass;
    }
    Vec2 operator()(const CustomForce& custom) const {
      return custom.evaluate(ForceState{position, v, time, body.mass}) / body.mass;
    }
  };
  return std::visit(Visitor{body, position, v, time, pull}, force.kind);
}

const Anchor* anchorOf(const Force& force) {
  if (const auto* spring = std::get_if<SpringForce>(&force.kind)) return &spring->to;
  if (const auto* attract = std::get_if<AttractForce>(&force.kind)) return &attract->to;
  return nullptr;
}

} // namespace

bool actsOn(const Force& force, const Body& body) {
  return (!force.group || *force.group == body.group) && (!force.body || *force.body == body.id);
}

std::optional<std::uint32_t> anchorBody(const Force& force) {
  const Anchor* anchor = anchorOf(force);
  return anchor != nullptr ? anchor->body : std::nullopt;
}

ForceField::ForceField(const WorldSetup& setup)
    : gravity_(setup.gravity),
      forces_(setup.forces),
      anchors_(setup.forces.size(), kNowhere),
      couples_(std::any_of(forces_.begin(), forces_.end(),
                           [](const Force& f) { return anchorBody(f).has_value(); })) {}

void ForceField::findAnchors(std::span<const Body> bodies) {
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    const std::optional<std::uint32_t> id = anchorBody(forces_[i]);
    if (!id) continue;
    const auto found =
        std::lower_bound(bodies.begin(), bodies.end(), *id,
                         [](const Body& body, std::uint32_t wanted) { return body.id < wanted; });
    const bool lives = found != bodies.end() && found->id == *id;
    anchors_[i] = lives ? static_cast<std::size_t>(found - bodies.begin()) : kNowhere;
  }
}

Vec2 ForceField::acceleration(std::span<const Body> bodies, std::size_t index, const Motion& motion,
                              double time, std::span<const Motion> everyone) const {
  const Body& body = bodies[index];
  Vec2 sum = (body.feelsGravity ? gravity_ : Vec2::Zero()) + body.acceleration;
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    const Force& force = forces_[i];
    const Anchor* anchor = anchorOf(force);
    Pull pull{anchor != nullptr ? anchor->point : Vec2::Zero(), Vec2::Zero()};
    if (anchor != nullptr && anchor->body) {
      const std::size_t at = anchors_[i];
      if (at == kNowhere) continue; // its body is gone, and the force with it
      pull = {centre(bodies[at], everyone[at].position),
              bodies[at].fixed ? Vec2::Zero() : everyone[at].velocity};
      if (at == index) {
        // The anchor of an attraction feels nothing; that of a spring feels every body that hangs on it.
        const auto* spring = std::get_if<SpringForce>(&force.kind);
        for (std::size_t j = 0; spring != nullptr && j < bodies.size(); ++j) {
          if (j == index || !actsOn(force, bodies[j])) continue;
          const Vec2 velocity = bodies[j].fixed ? Vec2::Zero() : everyone[j].velocity;
          sum -= springForce(*spring, centre(bodies[j], everyone[j].position), velocity, pull) / body.mass;
        }
        continue;
      }
    }
    if (actsOn(force, body)) sum += accelerationBy(force, body, motion, time, pull);
  }
  return sum;
}

} // namespace offstage
