#pragma once

#include "src/sim/body.h"

namespace offstage {

/// Whether steps of length h (s) are too long for a body on a spring, x'' = −frequency²·x − damping·x'
/// (frequency in rad/s, above 0; damping in 1/s, at least 0): so long that the motion grows where it must
/// not. One step is a linear map of (x, x'), made here by the integrator itself, and the motion grows when
/// an eigenvalue of that map is larger than 1 in magnitude. Without damping that is so from these steps on:
///
///   semi-implicit Euler, Verlet   h·frequency = 2       Hairer, Lubich, Wanner, Geometric Numerical
///                                                       Integration, section I.1.4 and I.5
///   RK4                           h·frequency = 2·√2    Hairer, Wanner, Solving Ordinary Differential
///                                                       Equations II, section IV.2: |R(iy)| ≤ 1
///   explicit Euler, midpoint      always                the same; |R(iy)|² = 1 + y² and 1 + y⁴/4
///
/// Since the last two grow with any step, a step is too long for them when the motion more than doubles in
/// one swing, 2π/frequency; undamped that is from h·frequency = 0.2262 and 0.9956 on. The closed form has no
/// limit.
bool isTooLong(Integrator method, double frequency, double damping, double h);

/// s: the longest step that is not too long, to 12 digits, below `tooLong`, a step that is.
double longestStep(Integrator method, double frequency, double damping, double tooLong);

} // namespace offstage
