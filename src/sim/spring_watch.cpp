#include "src/sim/spring_watch.h"

#include "src/sim/birth.h"
#include "src/sim/force_field.h"
#include "src/sim/spring_stability.h"

#include <algorithm>
#include <cmath>

namespace offstage {
namespace {

bool isSpring(const Force& force) {
  return std::holds_alternative<SpringForce>(force.kind);
}

/// 1/mass; 0 of a fixed body.
double lightness(const Body& body) {
  return body.fixed ? 0.0 : 1.0 / body.mass;
}

} // namespace

SpringWatch::SpringWatch(const WorldSetup& setup) {
  if (std::none_of(setup.forces.begin(), setup.forces.end(), isSpring)) return;
  for (const Force& force : setup.forces) {
    const bool slows =
        std::holds_alternative<DragForce>(force.kind) || std::holds_alternative<WindForce>(force.kind);
    if (isSpring(force) || slows) forces_.push_back(force);
  }
}

SpringWatch::Swing SpringWatch::swingOf(std::span<const Body> bodies, const Body& body) const {
  const double light = lightness(body);
  double together = 0.0; // 1/s²: of springs of length 0, which pull back in every direction
  double longest = 0.0;  // 1/s²: the stiffest of the others
  double pair = 0.0;     // 1/s²: the stiffest between two bodies
  double damped = 0.0;   // 1/s: by the spring that damps most, for each damps only along itself
  Swing swing;
  for (const Force& force : forces_) {
    if (const auto* drag = std::get_if<DragForce>(&force.kind)) {
      if (actsOn(force, body)) swing.damping += drag->linear * light;
      continue;
    }
    if (const auto* wind = std::get_if<WindForce>(&force.kind)) {
      if (actsOn(force, body)) swing.damping += wind->coefficient * light;
      continue;
    }
    const auto& spring = std::get<SpringForce>(force.kind);
    const auto pulls = [&](double otherLight) {
      const double stiffness = spring.stiffness * light;
      if (spring.length == 0.0)
        together += stiffness;
      else
        longest = std::max(longest, stiffness);
      pair = std::max(pair, spring.stiffness * (light + otherLight));
      damped = std::max(damped, spring.damping * (light + otherLight));
    };
    if (spring.to.body == body.id) { // it feels every body that hangs on it
      for (const Body& other : bodies)
        if (other.id != body.id && actsOn(force, other)) pulls(lightness(other));
    } else if (actsOn(force, body)) {
      const Body* tied = spring.to.body ? findBody(bodies, *spring.to.body) : nullptr;
      if (!spring.to.body || tied != nullptr) pulls(tied != nullptr ? lightness(*tied) : 0.0);
    }
  }
  swing.damping += damped;
  swing.frequency = std::sqrt(std::max(together + longest, pair));
  return swing;
}

std::optional<Warning> SpringWatch::find(std::span<const Body> bodies, double h) {
  if (forces_.empty() || bodies.empty()) return std::nullopt;
  const std::int64_t newest = bodies.back().id;
  if (h <= longest_ && newest == newest_) return std::nullopt;
  longest_ = std::max(longest_, h);
  newest_ = newest;
  for (const Body& body : bodies) {
    if (body.fixed || body.integrator == Integrator::Exact) continue;
    const auto [frequency, damping] = swingOf(bodies, body);
    if (!isTooLong(body.integrator, frequency, damping, h)) continue;
    Warning warning;
    warning.body = body.id;
    warning.group = body.group;
    warning.what =
        LongStep{h, longestStep(body.integrator, frequency, damping, h), frequency, body.integrator};
    return warning;
  }
  return std::nullopt;
}

} // namespace offstage
