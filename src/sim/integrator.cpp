#include "src/sim/integrator.h"

namespace offstage::stages {

std::size_t count(Integrator method) {
  switch (method) {
  case Integrator::ExplicitEuler:
  case Integrator::SemiImplicitEuler:
    return 1;
  case Integrator::Verlet:
  case Integrator::Midpoint:
    return 2;
  case Integrator::Rk4:
    return 4;
  case Integrator::Exact:
    break;
  }
  return 0;
}

double offset(Integrator method, std::size_t stage) {
  if (stage == 0) return 0.0;
  if (method == Integrator::Verlet) return 1.0;
  return stage == 3 ? 1.0 : 0.5; // of midpoint and RK4
}

Motion state(Integrator method, std::size_t stage, const Motion& start, const Accelerations& a, double h) {
  const Vec2& x = start.position;
  const Vec2& v = start.velocity;
  const double h2 = h * 0.5;
  if (stage == 0) return start;
  if (method == Integrator::Verlet) return {(x + v * h) + ((a[0] * 0.5) * h) * h, v + a[0] * h};
  if (stage == 1) return {x + v * h2, v + a[0] * h2};
  if (stage == 2) return {x + (v + a[0] * h2) * h2, v + a[1] * h2};
  return {x + (v + a[1] * h2) * h, v + a[2] * h};
}

Motion finish(Integrator method, const Motion& start, const Accelerations& a, double h) {
  const Vec2& x = start.position;
  const Vec2& v = start.velocity;
  const double h2 = h * 0.5;
  switch (method) {
  case Integrator::ExplicitEuler:
    return {x + v * h, v + a[0] * h};
  case Integrator::SemiImplicitEuler: {
    const Vec2 velocity = v + a[0] * h;
    return {x + velocity * h, velocity};
  }
  case Integrator::Verlet:
    return {(x + v * h) + ((a[0] * 0.5) * h) * h, v + (a[0] + a[1]) * h2};
  case Integrator::Midpoint:
    return {x + (v + a[0] * h2) * h, v + a[1] * h};
  case Integrator::Rk4: {
    const double h6 = h / 6.0;
    const Vec2 k2 = v + a[0] * h2;
    const Vec2 k3 = v + a[1] * h2;
    const Vec2 k4 = v + a[2] * h;
    const Vec2 slope = ((v + k2 * 2.0) + k3 * 2.0) + k4;
    const Vec2 curve = ((a[0] + a[1] * 2.0) + a[2] * 2.0) + a[3];
    return {x + slope * h6, v + curve * h6};
  }
  case Integrator::Exact:
    break;
  }
  return start;
}

} // namespace offstage::stages
