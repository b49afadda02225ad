#pragma once

#include "src/sim/body.h"
#include "src/sim/vec.h"

#include <array>
#include <cstddef>

namespace offstage {

/// The part of a body's state that an integrator moves.
struct Motion {
  Vec2 position = Vec2::Zero(); ///< px: Body::position
  Vec2 velocity = Vec2::Zero(); ///< px/s
};

/// The integrators as methods of stages: each stage asks for the acceleration at one state and time, and the
/// last one is followed by the step itself. With x, v, a the state before the step and its acceleration, h
/// the step, every line one rounding per sign, from left to right (the reference implementation's order):
///
///   explicit Euler       x' = x + v·h                       v' = v + a·h
///   semi-implicit Euler  v' = v + a·h                       x' = x + v'·h
///   velocity Verlet      x' = (x + v·h) + ((0.5·a)·h)·h     v' = v + (a + a1)·(h·0.5)
///                        with a1 at x', v + a·h, t + h
///   midpoint             x' = x + (v + a·h2)·h              v' = v + a1·h
///                        with h2 = h·0.5 and a1 at x + v·h2, v + a·h2, t + h2
///   classical RK4        x' = x + (k1 + k2·2 + k3·2 + k4)·(h/6), likewise v', the k's at t, t + h2, t + h2,
///   t + h
///
/// Orders of convergence 1, 1, 2, 2, 4. Sources: Hairer, Nørsett, Wanner, Solving Ordinary Differential
/// Equations I, sections II.1 (Euler, midpoint, RK4); Hairer, Lubich, Wanner, "Geometric numerical
/// integration illustrated by the Störmer–Verlet method", Acta Numerica 2003 (semi-implicit Euler, Verlet).
/// Verlet's predicted velocity v + a·h lets it meet forces that depend on velocity, at which it is Heun's
/// method for v.
namespace stages {

inline constexpr std::size_t kMost = 4;
using Accelerations = std::array<Vec2, kMost>; ///< px/s², of the stages so far

/// Stages of a step; of Exact 0, for its motion is not made from accelerations (closed_form.h).
std::size_t count(Integrator method);

/// Time of a stage as a share of the step: 0, 0.5 or 1.
double offset(Integrator method, std::size_t stage);

/// The state at which a stage asks for the acceleration; `a` holds those of the stages before it.
Motion state(Integrator method, std::size_t stage, const Motion& start, const Accelerations& a, double h);

/// The state after the step.
Motion finish(Integrator method, const Motion& start, const Accelerations& a, double h);

} // namespace stages

/// One step of one body by a method of stages. `acceleration(const Motion&, double time)` gives px/s²; it is
/// asked once a stage.
template <typename Acceleration>
Motion integrate(Integrator method, const Motion& start, double t, double h, Acceleration&& acceleration) {
  stages::Accelerations a{};
  for (std::size_t stage = 0; stage < stages::count(method); ++stage) {
    a[stage] = acceleration(stages::state(method, stage, start, a, h), t + stages::offset(method, stage) * h);
  }
  return stages::finish(method, start, a, h);
}

} // namespace offstage
