#include "src/sim/mover.h"

#include "src/sim/error.h"

#include <algorithm>
#include <string>

namespace offstage {
namespace {

[[noreturn]] void refuse(const Body& body, double time, const std::string& problem) {
  throw Error(ExitCode::BadInput, "body " + std::to_string(body.id) + " at " + std::to_string(time) +
                                      " s: no closed form for the integrator exact: " + problem);
}

bool isExact(const Body& body) {
  return body.integrator == Integrator::Exact && !body.fixed;
}

} // namespace

Mover::Mover(const WorldSetup& setup) : field_(setup) {}

void Mover::add(const WorldSetup& setup, const Body& body, double time) {
  if (!isExact(body)) return;
  ExactMotion exact{body.id, {}, {body.position, body.velocity}};
  if (const auto problem = exact.form.choose(setup, body)) refuse(body, time, *problem);
  if (const auto problem = exact.form.anchor(exact.last, time)) refuse(body, time, *problem);
  exact_.push_back(exact);
}

void Mover::keepOnly(std::span<const Body> living) {
  auto body = living.begin(); // both are in order of id
  std::erase_if(exact_, [&](const ExactMotion& exact) {
    while (body != living.end() && body->id < exact.id) ++body;
    return body == living.end() || body->id != exact.id;
  });
}

void Mover::begin(std::span<const Body> bodies, double t, double h) {
  auto body = bodies.begin();
  for (ExactMotion& exact : exact_) {
    while (body->id < exact.id) ++body;
    if (body->position == exact.last.position && body->velocity == exact.last.velocity) continue;
    if (const auto problem = exact.form.anchor({body->position, body->velocity}, t))
      refuse(*body, t, *problem);
  }
  if (!field_.couples()) return;
  field_.findAnchors(bodies);
  stepTogether(bodies, t, h);
}

Motion Mover::next(std::span<const Body> bodies, std::size_t index, double t, double h, double end) {
  const Body& body = bodies[index];
  if (isExact(body)) {
    ExactMotion& exact = exact_[exactIndex(body.id)];
    exact.last = exact.form.at(end);
    return exact.last;
  }
  if (field_.couples()) return stages::finish(body.integrator, start_[index], accelerations_[index], h);
  return integrate(body.integrator, {body.position, body.velocity}, t, h,
                   [&](const Motion& motion, double time) {
                     return field_.acceleration(bodies, index, motion, time, {});
                   });
}

std::size_t Mover::exactIndex(std::uint32_t id) const {
  const auto found =
      std::lower_bound(exact_.begin(), exact_.end(), id,
                       [](const ExactMotion& exact, std::uint32_t wanted) { return exact.id < wanted; });
  return static_cast<std::size_t>(found - exact_.begin());
}

Motion Mover::atStage(const Body& body, std::size_t index, Integrator method, std::size_t stage, double t,
                      double h) const {
  const Motion& start = start_[index];
  if (body.fixed || stage == 0) return start;
  const stages::Accelerations& a = accelerations_[index];
  if (body.integrator == method) return stages::state(method, stage, start, a, h);
  const double tau = stages::offset(method, stage) * h;
  if (isExact(body)) return exact_[exactIndex(body.id)].form.at(t + tau);
  return {(start.position + start.velocity * tau) + ((a[0] * 0.5) * tau) * tau, start.velocity + a[0] * tau};
}

void Mover::stepTogether(std::span<const Body> bodies, double t, double h) {
  start_.clear();
  for (const Body& body : bodies) start_.push_back({body.position, body.velocity});
  everyone_.resize(bodies.size());
  accelerations_.resize(bodies.size());

  static constexpr std::array kMethods{Integrator::ExplicitEuler, Integrator::SemiImplicitEuler,
                                       Integrator::Verlet, Integrator::Midpoint, Integrator::Rk4};
  // Stage 0 of every method before any further one: extrapolation needs everybody's first acceleration.
  for (std::size_t stage = 0; stage < stages::kMost; ++stage) {
    for (const Integrator method : kMethods) {
      const auto takesPart = [&](const Body& body) { return body.integrator == method && !body.fixed; };
      if (stage >= stages::count(method) || std::none_of(bodies.begin(), bodies.end(), takesPart)) continue;
      const double time = t + stages::offset(method, stage) * h;
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        everyone_[i] = atStage(bodies[i], i, method, stage, t, h);
      }
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (!takesPart(bodies[i])) continue;
        accelerations_[i][stage] = field_.acceleration(bodies, i, everyone_[i], time, everyone_);
      }
    }
  }
}

} // namespace offstage
