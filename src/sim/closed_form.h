#pragma once

#include "src/sim/integrator.h"
#include "src/sim/world_setup.h"

#include <optional>
#include <string>
#include <variant>

namespace offstage {

/// The laws of ClosedForm, with what they need of the forces and of the anchor state.
namespace laws {

struct Uniform {
  Vec2 acceleration = Vec2::Zero(); ///< px/s²
};

struct Oscillation {
  Vec2 centre = Vec2::Zero(); ///< px: where nothing pulls (as Body::position)
  double omega = 0.0;         ///< 1/s, > 0
};

struct Orbit {
  Vec2 focus = Vec2::Zero(); ///< px (as Body::position)
  double strength = 0.0;     ///< px³/s², > 0
  double radius = 0.0;       ///< px: of the anchor state, as all that follow
  double semiMajor = 0.0;    ///< px
  double rate = 0.0;         ///< 1/s: the mean motion √(strength/semiMajor³)
  double eCos = 0.0;         ///< e·cos E0 = 1 − radius/semiMajor
  double eSin = 0.0;         ///< e·sin E0 = (x0·v0)/√(strength·semiMajor)
};

} // namespace laws

/// A motion as a function of the time since an anchor state, for the bodies of Integrator::Exact. A step's
/// length does not enter, so it has no error but rounding. With x0, v0 the state at the anchor and t the time
/// since:
///
/// uniform acceleration a   x = (x0 + v0·t) + ((0.5·a)·t)·t,  v = v0 + a·t
/// undamped spring of length 0 to a point c, with a constant acceleration g beside it
///                          ω = √(stiffness/mass), about the centre c + g/ω²; d = x0 − centre:
///                          x = centre + (d·cos ωt + (v0/ω)·sin ωt),  v = v0·cos ωt − (d·ω)·sin ωt
/// attraction to a point    the ellipse through Kepler's equation for the change E of eccentric anomaly, and
///                          Lagrange's f and g: x = f·x0 + g·v0, v = f'·x0 + g'·v0 about the point. Source:
///                          Battin, An Introduction to the Mathematics and Methods of Astrodynamics,
///                          section 4.3.
///
/// sin and cos are those of strict_math.h, so that the bits are the same everywhere.
class ClosedForm {
public:
  /// Takes the law from the forces of a setup that act on a body. Returns why there is none, or nothing.
  [[nodiscard]] std::optional<std::string> choose(const WorldSetup& setup, const Body& body);

  /// Starts the motion anew at `start`, the state at `time` (s). Returns why there is no closed form from
  /// there (the orbit is not an ellipse), or nothing.
  [[nodiscard]] std::optional<std::string> anchor(const Motion& start, double time);

  [[nodiscard]] Motion at(double time) const; ///< s; of the world, not since the anchor

private:
  [[nodiscard]] Motion along(const laws::Uniform& law, double t) const;
  [[nodiscard]] Motion along(const laws::Oscillation& law, double t) const;
  [[nodiscard]] Motion along(const laws::Orbit& law, double t) const;

  std::variant<laws::Uniform, laws::Oscillation, laws::Orbit> law_;
  Motion start_;
  double time_ = 0.0;
};

/// Why a body whose integrator is (or were to be) Exact has no closed form: forces that have none (drag,
/// wind, a custom force, a spring with a length or damping, one tied to a body, several at once, …), or a
/// start that is not an ellipse about its attraction (parabola, hyperbola, straight fall). Nothing when it
/// has one.
std::optional<std::string> closedFormProblem(const WorldSetup& setup, const Body& body);

/// The same by the forces alone, for a spawner's or a launch's prototype, whose start is not known yet.
std::optional<std::string> closedFormForceProblem(const WorldSetup& setup, const Body& prototype);

} // namespace offstage
