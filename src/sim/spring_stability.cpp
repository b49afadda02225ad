#include "src/sim/spring_stability.h"

#include "src/sim/integrator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace offstage {
namespace {

/// What rounding makes of an eigenvalue of magnitude 1.
constexpr double kRounding = 1e-9;
/// How much a motion may grow in one swing, where it always grows.
constexpr double kGrowth = 2.0;

/// The larger magnitude of the eigenvalues of [[a, b], [c, d]].
double spectralRadius(double a, double b, double c, double d) {
  const double half = 0.5 * (a + d);
  const double determinant = a * d - b * c;
  const double root = half * half - determinant;
  if (root < 0.0) return std::sqrt(determinant); // a conjugate pair
  return std::abs(half) + std::sqrt(root);
}

/// By how much a step stretches the motion at most, in the long run. Lengths and times in units in which the
/// frequency is 1.
double growthOf(Integrator method, double damping, double h) {
  const auto stepped = [&](const Motion& start) {
    return integrate(method, start, 0.0, h, [damping](const Motion& motion, double) {
      return Vec2(-motion.position - motion.velocity * damping);
    });
  };
  // x and y are two springs of their own: one starts out of rest, the other with a speed.
  const Motion end = stepped({Vec2(1.0, 0.0), Vec2(0.0, 1.0)});
  return spectralRadius(end.position.x(), end.position.y(), end.velocity.x(), end.velocity.y());
}

} // namespace

bool isTooLong(Integrator method, double frequency, double damping, double h) {
  if (method == Integrator::Exact || !(frequency > 0.0) || !(h > 0.0)) return false;
  const double growth = growthOf(method, damping / frequency, h * frequency);
  if (!(growth > 1.0 + kRounding)) return std::isnan(growth);
  if (method != Integrator::ExplicitEuler && method != Integrator::Midpoint) return true;
  const double stepsInASwing = 2.0 * std::numbers::pi / (h * frequency);
  return std::log(growth) * stepsInASwing > std::log(kGrowth);
}

double longestStep(Integrator method, double frequency, double damping, double tooLong) {
  double low = 0.0;
  double high = tooLong;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (isTooLong(method, frequency, damping, middle) ? high : low) = middle;
  }
  return low;
}

} // namespace offstage
