#include "src/sim/force.h"
#include "src/sim/world.h"
#include "tests/support/sim_setup.h"

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// One explicit Euler step of length 1 from rest to read off the acceleration: v' = v + a.
Vec2 accelerationOf(const WorldSetup& setup, std::size_t index = 0) {
  WorldSetup probe = setup;
  for (Body& body : probe.bodies) body.integrator = Integrator::ExplicitEuler;
  World world(probe);
  const Vec2 before = world.bodies()[index].velocity;
  world.step({1, 1.0, 1.0});
  return world.bodies()[index].velocity - before;
}

WorldSetup oneBody(const Force& force, double mass = 1.0) {
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  Body body;
  body.position = Vec2(30, 40);
  body.velocity = Vec2(3, -4);
  body.mass = mass;
  setup.bodies = {body};
  addForce(setup, force);
  return setup;
}

void expectNear(const Vec2& a, const Vec2& b) {
  EXPECT_LT(length(a - b), 1e-12) << a.transpose() << " instead of " << b.transpose();
}

TEST(Force, DragActsAgainstTheVelocityAndIsDividedByTheMass) {
  expectNear(accelerationOf(oneBody({DragForce{.linear = 0.5, .quadratic = 0.1}, {}, {}}, 2.0)),
             Vec2(-(0.5 * 3 + 0.1 * 5 * 3), 0.5 * 4 + 0.1 * 5 * 4) / 2.0);
}

TEST(Force, WindDragsTowardsTheAirsVelocity) {
  expectNear(accelerationOf(oneBody({WindForce{Vec2(10, 0), 0.5}, {}, {}}, 2.0)),
             Vec2(0.5 * 7, 0.5 * 4) / 2.0);
}

TEST(Force, SpringPullsTowardsItsLengthAndDampsAlongItself) {
  const SpringForce spring{.to = {Vec2(0, 0), {}}, .stiffness = 2.0, .length = 10.0, .damping = 0.5};
  // d = (30, 40), |d| = 50, direction (0.6, 0.8), speed along it 1.8 − 3.2 = −1.4.
  const Vec2 direction(0.6, 0.8);
  expectNear(accelerationOf(oneBody({spring, {}, {}}, 4.0)), direction * ((-2.0 * 40.0 + 0.5 * 1.4) / 4.0));
}

TEST(Force, AttractionIsAnAccelerationWhateverTheMass) {
  const AttractForce attract{.to = {Vec2(0, 0), {}}, .strength = 1000.0};
  const Vec2 expected = Vec2(30, 40) * (-1000.0 / (50.0 * 50.0 * 50.0));
  expectNear(accelerationOf(oneBody({attract, {}, {}}, 1.0)), expected);
  expectNear(accelerationOf(oneBody({attract, {}, {}}, 7.0)), expected);
}

TEST(Force, SofteningKeepsAttractionFiniteAtItsCentre) {
  WorldSetup setup = oneBody({AttractForce{.to = {Vec2(30, 40), {}}, .strength = 1000.0}, {}, {}});
  expectNear(accelerationOf(setup), Vec2(0, 0)); // no direction at the centre itself
  setup.forces[0] = {AttractForce{.to = {Vec2(0, 40), {}}, .strength = 1000.0, .softening = 40.0}, {}, {}};
  expectNear(accelerationOf(setup), Vec2(-30.0 * 1000.0 / 125000.0, 0));
}

TEST(Force, SumIsGravityThenTheBodysOwnThenEachForceInOrder) {
  WorldSetup setup = oneBody({CustomForce{[](const ForceState&) { return Vec2(0, 1); }}, {}, {}});
  setup.gravity = Vec2(0, 1e16);
  setup.bodies[0].velocity = Vec2::Zero();
  setup.bodies[0].acceleration = Vec2(0, 1);
  addForce(setup, {CustomForce{[](const ForceState&) { return Vec2(0, -1e16); }}, {}, {}});
  // ((1e16 + 1) + 1) − 1e16 is 0 in doubles, where any other order gives 2 or 1.
  EXPECT_EQ(accelerationOf(setup), Vec2(0, 0));
}

TEST(Force, GroupAndBodyFiltersChooseWhomAForceActsOn) {
  WorldSetup setup = oneBody({CustomForce{[](const ForceState&) { return Vec2(1, 0); }}, 1U, {}});
  setup.groups = {"a", "b"};
  setup.bodies.push_back(setup.bodies[0]);
  setup.bodies[1].group = 1;
  addForce(setup, {CustomForce{[](const ForceState&) { return Vec2(0, 1); }}, {}, 0U});
  EXPECT_EQ(accelerationOf(setup, 0), Vec2(0, 1));
  EXPECT_EQ(accelerationOf(setup, 1), Vec2(1, 0));
}

TEST(Force, CustomForceSeesTheStateOfEachStage) {
  std::vector<ForceState> seen;
  WorldSetup setup = oneBody({CustomForce{[&seen](const ForceState& state) {
                                seen.push_back(state);
                                return Vec2(0, 0);
                              }},
                              {},
                              {}},
                             3.0);
  setup.bodies[0].integrator = Integrator::Rk4;
  World world(setup);
  world.step({1, 2.0, 2.0});
  world.step({2, 4.0, 2.0});
  ASSERT_EQ(seen.size(), 8U) << "RK4 evaluates a force four times a step";
  const std::vector<double> times{0, 1, 1, 2, 2, 3, 3, 4};
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].time, times[i]) << "stage " << i;
    EXPECT_EQ(seen[i].position, Vec2(30, 40) + Vec2(3, -4) * times[i]) << "stage " << i;
    EXPECT_EQ(seen[i].mass, 3.0);
  }
}

TEST(Force, RectangleIsPulledAtItsCentre) {
  WorldSetup setup = oneBody({SpringForce{.to = {Vec2(0, 0), {}}, .stiffness = 1.0}, {}, {}});
  setup.bodies[0].shape = Shape::Rectangle;
  setup.bodies[0].size = Vec2(20, 10);
  expectNear(accelerationOf(setup), -Vec2(40, 45));
}

TEST(Force, SpringBetweenTwoBodiesActsOnBothEquallyAndOppositely) {
  WorldSetup setup = oneBody(
      {SpringForce{.to = {Vec2::Zero(), 1U}, .stiffness = 2.0, .length = 5.0, .damping = 0.25}, {}, 0U}, 2.0);
  Body other = setup.bodies[0];
  other.position = Vec2(90, 120);
  other.velocity = Vec2(-5, 1);
  other.mass = 7.0;
  setup.bodies.push_back(other);
  const Vec2 a0 = accelerationOf(setup, 0);
  const Vec2 a1 = accelerationOf(setup, 1);
  EXPECT_GT(length(a0), 1.0);
  expectNear(a0 * 2.0, a1 * -7.0);
  // Joined bodies keep their common momentum whatever the integrator.
  for (const Integrator method : {Integrator::SemiImplicitEuler, Integrator::Verlet, Integrator::Rk4}) {
    for (Body& body : setup.bodies) body.integrator = method;
    World world(setup);
    for (int i = 1; i <= 100; ++i) world.step({i, i * 0.01, 0.01});
    const Vec2 momentum = world.bodies()[0].velocity * 2.0 + world.bodies()[1].velocity * 7.0;
    EXPECT_LT(length(momentum - (Vec2(3, -4) * 2.0 + Vec2(-5, 1) * 7.0)), 1e-11) << static_cast<int>(method);
  }
}

TEST(Force, AnchorOfASpringFeelsEveryBodyThatHangsOnIt) {
  WorldSetup setup = oneBody({SpringForce{.to = {Vec2::Zero(), 0U}, .stiffness = 2.0}, 1U, {}});
  setup.groups = {"hub", "spokes"};
  Body spoke = setup.bodies[0];
  spoke.group = 1;
  spoke.position = Vec2(50, 40);
  setup.bodies.push_back(spoke);
  spoke.position = Vec2(30, 70);
  setup.bodies.push_back(spoke);
  expectNear(accelerationOf(setup, 0), Vec2(40, 60));
  setup.bodies[2].fixed = true; // a fixed one pulls all the same
  expectNear(accelerationOf(setup, 0), Vec2(40, 60));
}

TEST(Force, AttractionToABodyIsOneSidedAndGoesWithIt) {
  WorldSetup setup = oneBody({AttractForce{.to = {Vec2::Zero(), 1U}, .strength = 1000.0}, {}, {}});
  Body sun = setup.bodies[0];
  sun.position = Vec2(30, 90);
  sun.radius = 5.0;
  sun.removedOutside = true;
  sun.velocity = Vec2(5000, 0);
  setup.bodies.push_back(sun);
  expectNear(accelerationOf(setup, 0), Vec2(0, 0.4));
  expectNear(accelerationOf(setup, 1), Vec2(0, 0));
  World world(setup);
  world.step({1, 1.0, 1.0});
  ASSERT_EQ(world.find(1), nullptr) << "the sun has left the pane";
  const Vec2 velocity = world.bodies()[0].velocity;
  world.step({2, 2.0, 1.0});
  EXPECT_EQ(world.bodies()[0].velocity, velocity) << "when the body is gone, the force is gone";
}

} // namespace
} // namespace offstage::test
