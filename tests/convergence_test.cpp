// Observed order of convergence: with the step halved, the error at a fixed time falls by 2^order.
#include "src/sim/strict_math.h"
#include "src/sim/world.h"
#include "tests/support/sim_setup.h"

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

struct Method {
  Integrator integrator;
  double order;
  std::string name;
};

const std::vector<Method>& methods() {
  static const std::vector<Method> kMethods{{Integrator::ExplicitEuler, 1.0, "ExplicitEuler"},
                                            {Integrator::SemiImplicitEuler, 1.0, "SemiImplicitEuler"},
                                            {Integrator::Verlet, 2.0, "Verlet"},
                                            {Integrator::Midpoint, 2.0, "Midpoint"},
                                            {Integrator::Rk4, 4.0, "Rk4"}};
  return kMethods;
}

constexpr double kSeconds = 1.0;

World runTo(const WorldSetup& setup, int steps) {
  const Clock clock = Clock::fixed(steps / kSeconds, steps);
  World world(setup);
  for (std::int64_t frame = 1; frame <= clock.steps(); ++frame) world.step(clock.tick(frame));
  return world;
}

double distance(const World& a, const World& b) {
  double square = 0.0;
  for (std::size_t i = 0; i < a.bodies().size(); ++i) {
    const Body& p = a.bodies()[i];
    const Body& q = b.bodies()[i];
    square += (p.position - q.position).squaredNorm() + (p.velocity - q.velocity).squaredNorm();
  }
  return std::sqrt(square);
}

/// log2 of how much two halvings of the step bring the result nearer, by three runs and no closed form: with
/// error C·h^p the differences of successive runs are in the ratio 2^p.
double observedOrder(const WorldSetup& setup, int steps) {
  const World coarse = runTo(setup, steps);
  const World middle = runTo(setup, 2 * steps);
  const World fine = runTo(setup, 4 * steps);
  return std::log2(distance(coarse, middle) / distance(middle, fine));
}

Body ball(double x, double y, double vx, double vy, Integrator integrator) {
  Body body;
  body.position = Vec2(x, y);
  body.velocity = Vec2(vx, vy);
  body.integrator = integrator;
  body.radius = 5.0;
  return body;
}

class Convergence : public testing::TestWithParam<Method> {};

TEST_P(Convergence, OnTheOscillatorIsTheMethodsOrderAgainstTheClosedForm) {
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  setup.bodies = {ball(470, 240, 0, 100, GetParam().integrator)};
  addForce(setup, {SpringForce{.to = {Vec2(320, 240), {}}, .stiffness = 4.0}, {}, {}});
  WorldSetup exact = setup;
  exact.bodies[0].integrator = Integrator::Exact;
  const World truth = runTo(exact, 1);
  const double coarse = distance(runTo(setup, 200), truth);
  const double fine = distance(runTo(setup, 400), truth);
  EXPECT_NEAR(std::log2(coarse / fine), GetParam().order, 0.1) << "errors " << coarse << ' ' << fine;
}

TEST_P(Convergence, OnAnEllipticOrbitIsTheMethodsOrderAgainstTheClosedForm) {
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  setup.bodies = {ball(470, 240, 30, 250, GetParam().integrator)};
  addForce(setup, {AttractForce{.to = {Vec2(320, 240), {}}, .strength = 1.35e7}, {}, {}});
  WorldSetup exact = setup;
  exact.bodies[0].integrator = Integrator::Exact;
  const World truth = runTo(exact, 1);
  const int steps = GetParam().order == 1.0 ? 12800 : 400;
  const double coarse = distance(runTo(setup, steps), truth);
  const double fine = distance(runTo(setup, 2 * steps), truth);
  EXPECT_NEAR(std::log2(coarse / fine), GetParam().order, 0.1) << "errors " << coarse << ' ' << fine;
}

TEST_P(Convergence, HoldsForForcesOfVelocityAndTime) {
  WorldSetup setup;
  setup.bodies = {ball(100, 100, 200, -150, GetParam().integrator)};
  addForce(setup, {DragForce{.linear = 0.8, .quadratic = 0.004}, {}, {}});
  addForce(setup, {WindForce{Vec2(-40.0, 10.0), 0.5}, {}, {}});
  addForce(setup, {CustomForce{[](const ForceState& s) {
                     return Vec2(300.0 * strict::sin(3.0 * s.time), -2.0 * s.position.x());
                   }},
                   {},
                   {}});
  EXPECT_NEAR(observedOrder(setup, GetParam().order == 1.0 ? 1600 : 100), GetParam().order, 0.1);
}

TEST_P(Convergence, HoldsForTwoBodiesJoinedByASpring) {
  // With a rest length and damping the problem is not linear; the bodies turn about each other.
  WorldSetup setup;
  setup.gravity = Vec2(0.0, 50.0);
  setup.bodies = {ball(250, 240, 0, 80, GetParam().integrator),
                  ball(350, 240, 0, -60, GetParam().integrator)};
  setup.bodies[1].mass = 2.5;
  addForce(
      setup,
      {SpringForce{.to = {Vec2::Zero(), 1U}, .stiffness = 12.0, .length = 70.0, .damping = 0.3}, {}, 0U});
  EXPECT_NEAR(observedOrder(setup, GetParam().order == 1.0 ? 1600 : 100), GetParam().order, 0.1);
}

TEST_P(Convergence, HoldsForABodyThatChasesOneOnAClosedForm) {
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  setup.groups = {"sun", "chaser"};
  setup.bodies = {ball(470, 240, 0, 100, Integrator::Exact), ball(100, 100, 40, 0, GetParam().integrator)};
  setup.bodies[1].group = 1;
  addForce(setup, {SpringForce{.to = {Vec2(320, 240), {}}, .stiffness = 9.0}, 0U, {}});
  addForce(setup, {AttractForce{.to = {Vec2::Zero(), 0U}, .strength = 4e6, .softening = 60.0}, 1U, {}});
  EXPECT_NEAR(observedOrder(setup, GetParam().order == 1.0 ? 1600 : 100), GetParam().order, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Methods, Convergence, testing::ValuesIn(methods()),
                         [](const auto& test) { return test.param.name; });

TEST(Convergence, OfMixedMethodsIsThatOfTheLowerOne) {
  // Verlet and RK4 joined: the RK4 body sees the other one extrapolated, which must not fall below order 2.
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  setup.bodies = {ball(250, 240, 0, 80, Integrator::Verlet), ball(350, 240, 0, -60, Integrator::Rk4)};
  addForce(setup, {SpringForce{.to = {Vec2::Zero(), 1U}, .stiffness = 12.0, .length = 70.0}, {}, 0U});
  EXPECT_NEAR(observedOrder(setup, 200), 2.0, 0.1);
}

} // namespace
} // namespace offstage::test
