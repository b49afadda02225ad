#include "src/sim/closed_form.h"

#include "src/sim/force_field.h"
#include "src/sim/strict_math.h"

#include <cmath>

namespace offstage {
namespace {

// 2π in two parts, the first of 33 bits, so that a whole number of turns is taken off without rounding.
constexpr double kTurnHigh = 4.0 * 1.57079632673412561417e+00;
constexpr double kTurnLow = 4.0 * 6.07710050650619224932e-11;
constexpr double kTurn = 6.28318530717958647693;

/// The change E of eccentric anomaly in [0, 2π] for a change `mean` of mean anomaly in [0, 2π], by Kepler's
/// equation mean = E − eCos·sin E + eSin·(1 − cos E) (Battin, equation 4.43). Newton's method inside a
/// bracket: the right side grows with E, so each value tells on which side the root is, and bisection takes
/// over where Newton leaves it.
double solveKepler(double mean, double eCos, double eSin) {
  constexpr int most = 100; // bisection alone needs fewer than 64
  double low = 0.0;
  double high = kTurn;
  double anomaly = mean;
  for (int i = 0; i < most; ++i) {
    const double s = strict::sin(0.5 * anomaly);
    const double c = strict::cos(0.5 * anomaly);
    const double sine = 2.0 * s * c;
    const double versine = 2.0 * s * s; // 1 − cos E without cancellation
    const double excess = (anomaly - eCos * sine) + eSin * versine - mean;
    if (excess == 0.0) return anomaly;
    (excess > 0.0 ? high : low) = anomaly;
    const double slope = 1.0 - eCos * (1.0 - versine) + eSin * sine;
    double next = anomaly - excess / slope;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (next == anomaly) return next;
    anomaly = next;
  }
  return anomaly;
}

/// A force that is zero whatever the state.
bool isNothing(const Force& force) {
  struct Visitor {
    bool operator()(const DragForce& f) const { return f.linear == 0.0 && f.quadratic == 0.0; }
    bool operator()(const SpringForce& f) const { return f.stiffness == 0.0 && f.damping == 0.0; }
    bool operator()(const AttractForce& f) const { return f.strength == 0.0; }
    bool operator()(const WindForce& f) const { return f.coefficient == 0.0; }
    bool operator()(const CustomForce&) const { return false; }
  };
  return std::visit(Visitor{}, force.kind);
}

/// Why no body can have a closed form under this force, or nothing.
std::optional<std::string> problemOf(const Force& force) {
  struct Visitor {
    using Problem = std::optional<std::string>;
    Problem operator()(const DragForce&) const { return "drag acts on it"; }
    Problem operator()(const SpringForce& f) const {
      if (f.to.body) return "its spring is tied to a body";
      if (f.length != 0.0) return "its spring has a length";
      if (f.damping != 0.0) return "its spring is damped";
      return std::nullopt;
    }
    Problem operator()(const AttractForce& f) const {
      if (f.to.body) return "it is attracted to a body";
      if (f.softening != 0.0) return "its attraction is softened";
      if (!(f.strength > 0.0)) return "it is repelled, so its orbit is not an ellipse";
      return std::nullopt;
    }
    Problem operator()(const WindForce&) const { return "wind acts on it"; }
    Problem operator()(const CustomForce&) const { return "a custom force acts on it"; }
  };
  return std::visit(Visitor{}, force.kind);
}

} // namespace

std::optional<std::string> ClosedForm::choose(const WorldSetup& setup, const Body& body) {
  const Force* only = nullptr;
  for (const Force& force : setup.forces) {
    if (isNothing(force)) continue;
    const auto* spring = std::get_if<SpringForce>(&force.kind);
    if (spring != nullptr && spring->to.body == body.id) return "a spring of another body hangs on it";
    if (!actsOn(force, body)) continue;
    if (only != nullptr) return "several forces act on it";
    if (auto problem = problemOf(force)) return problem;
    only = &force;
  }
  const Vec2 uniform = (body.feelsGravity ? setup.gravity : Vec2::Zero()) + body.acceleration;
  if (only == nullptr) {
    law_.emplace<laws::Uniform>().acceleration = uniform;
    return std::nullopt;
  }
  // Forces act at the centre; the closed form moves Body::position, so points are shifted by the difference.
  const Vec2 shift = centre(body, Vec2::Zero());
  if (const auto* spring = std::get_if<SpringForce>(&only->kind)) {
    const double square = spring->stiffness / body.mass;
    auto& law = law_.emplace<laws::Oscillation>();
    law.centre = (spring->to.point - shift) + uniform / square;
    law.omega = strict::sqrt(square);
    return std::nullopt;
  }
  if (uniform != Vec2::Zero()) return "gravity or an acceleration of its own acts beside the attraction";
  const auto& attract = std::get<AttractForce>(only->kind);
  auto& law = law_.emplace<laws::Orbit>();
  law.focus = attract.to.point - shift;
  law.strength = attract.strength;
  return std::nullopt;
}

std::optional<std::string> ClosedForm::anchor(const Motion& start, double time) {
  start_ = start;
  time_ = time;
  auto* orbit = std::get_if<laws::Orbit>(&law_);
  if (orbit == nullptr) return std::nullopt;
  const Vec2 d = start.position - orbit->focus;
  const Vec2& v = start.velocity;
  const double radius = length(d);
  if (!(d.x() * v.y() - d.y() * v.x() != 0.0))
    return "it falls straight into the centre of attraction (or away from it)";
  const double inverse = 2.0 / radius - dot(v, v) / orbit->strength; // 1/semiMajor, by the vis-viva equation
  if (!(inverse > 0.0) || !std::isfinite(inverse))
    return "its orbit is not an ellipse: it is fast enough to escape";
  orbit->radius = radius;
  orbit->semiMajor = 1.0 / inverse;
  orbit->rate = strict::sqrt(orbit->strength * inverse) * inverse;
  orbit->eCos = 1.0 - radius * inverse;
  orbit->eSin = dot(d, v) / strict::sqrt(orbit->strength * orbit->semiMajor);
  return std::nullopt;
}

Motion ClosedForm::at(double time) const {
  const double t = time - time_;
  return std::visit([this, t](const auto& law) { return along(law, t); }, law_);
}

Motion ClosedForm::along(const laws::Uniform& law, double t) const {
  const Vec2& a = law.acceleration;
  return {(start_.position + start_.velocity * t) + ((a * 0.5) * t) * t, start_.velocity + a * t};
}

Motion ClosedForm::along(const laws::Oscillation& law, double t) const {
  const double c = strict::cos(law.omega * t);
  const double s = strict::sin(law.omega * t);
  const Vec2 d = start_.position - law.centre;
  return {law.centre + (d * c + (start_.velocity / law.omega) * s),
          start_.velocity * c - (d * law.omega) * s};
}

Motion ClosedForm::along(const laws::Orbit& law, double t) const {
  double mean = law.rate * t;
  const double turns = std::floor(mean / kTurn);
  mean = (mean - turns * kTurnHigh) - turns * kTurnLow;
  const double anomaly = solveKepler(mean, law.eCos, law.eSin);
  const double s = strict::sin(0.5 * anomaly);
  const double sine = 2.0 * s * strict::cos(0.5 * anomaly);
  const double versine = 2.0 * s * s; // 1 − cos E
  // In units of the semi-major axis and its mean motion: radii r0 = 1 − eCos and r = dM/dE.
  const double r0 = law.radius / law.semiMajor;
  const double r = 1.0 - law.eCos * (1.0 - versine) + law.eSin * sine;
  const double f = 1.0 - versine / r0;
  const double g = (r0 * sine + law.eSin * versine) / law.rate;
  const double fRate = -(law.rate * sine) / (r * r0);
  const double gRate = 1.0 - versine / r;
  const Vec2 d = start_.position - law.focus;
  const Vec2& v = start_.velocity;
  return {law.focus + (d * f + v * g), d * fRate + v * gRate};
}

std::optional<std::string> closedFormProblem(const WorldSetup& setup, const Body& body) {
  if (body.fixed) return std::nullopt; // it never moves
  ClosedForm form;
  if (auto problem = form.choose(setup, body)) return problem;
  return form.anchor({body.position, body.velocity}, 0.0);
}

std::optional<std::string> closedFormForceProblem(const WorldSetup& setup, const Body& prototype) {
  Body unborn = prototype;
  unborn.id = 0xffffffffU; // no force is tied to a body that does not exist yet
  if (unborn.fixed) return std::nullopt;
  return ClosedForm().choose(setup, unborn);
}

} // namespace offstage
