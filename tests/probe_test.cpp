#include "src/scene/probe_name.h"
#include "src/sim/probe.h"
#include "src/sim/world.h"
#include "tests/support/scene_text.h"
#include "tests/support/sim_setup.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// Bodies 0 "ball", 1 "exact", both of group 0 "balls", and 2 of group 1 "boxes".
WorldSetup setupOfThree() {
  WorldSetup setup;
  setup.groups = {"balls", "boxes"};
  setup.gravity = {0.0, 10.0};
  setup.bodies = {circle(100, 80, 5, Vec2(3, -4), 2.0), circle(103, 84, 5, Vec2(1, 0), 6.0)};
  Body box = rectangle(10, 20, 30, 40, Vec2(0, 7));
  box.group = 1;
  setup.bodies.push_back(box);
  return setup;
}

SceneBuilder namesOfThree() {
  SceneBuilder builder("scene.toml");
  builder.addGroup("balls");
  builder.addGroup("boxes");
  builder.bodies = {{"ball", 0}, {"exact", 1}};
  return builder;
}

double valueIn(const World& world, const SceneBuilder& builder, std::string_view name) {
  return valueOf(findProbe(builder, name).probe, snapshotOf(world));
}

std::string problemOf(const SceneBuilder& builder, std::string_view name) {
  try {
    return "no problem: " + findProbe(builder, name).name;
  } catch (const ProbeError& error) {
    return error.what();
  }
}

TEST(Probe, TellsOfOneBodyWhatTraceTells) {
  const World world(setupOfThree());
  const SceneBuilder builder = namesOfThree();
  EXPECT_EQ(valueIn(world, builder, "ball.x"), 100.0);
  EXPECT_EQ(valueIn(world, builder, " ball . y "), 80.0);
  EXPECT_EQ(valueIn(world, builder, "ball.vx"), 3.0);
  EXPECT_EQ(valueIn(world, builder, "ball.vy"), -4.0);
  EXPECT_EQ(valueIn(world, builder, "ball.speed"), 5.0);
  EXPECT_EQ(valueIn(world, builder, "ball.px"), 6.0);
  EXPECT_EQ(valueIn(world, builder, "ball.py"), -8.0);
  EXPECT_EQ(valueIn(world, builder, "ball.momentum"), 10.0);
  EXPECT_EQ(valueIn(world, builder, "ball.kinetic"), 25.0);
  EXPECT_EQ(valueIn(world, builder, "ball.potential"), 2.0 * 10.0 * (480.0 - 80.0));
  EXPECT_EQ(valueIn(world, builder, "ball.energy"), 25.0 + 8000.0);
  EXPECT_EQ(valueIn(world, builder, "ball.count"), 1.0);
  EXPECT_EQ(valueIn(world, builder, "ball.error(exact)"), 5.0);
  EXPECT_EQ(valueIn(world, builder, "#2.x"), 10.0) << "a rectangle's position is its corner, as in trace";
}

TEST(Probe, TellsOfAGroupAndOfAllWhatTheirSystemDoes) {
  const World world(setupOfThree());
  const SceneBuilder builder = namesOfThree();
  EXPECT_EQ(valueIn(world, builder, "balls.count"), 2.0);
  EXPECT_EQ(valueIn(world, builder, "balls.x"), (2.0 * 100.0 + 6.0 * 103.0) / 8.0);
  EXPECT_EQ(valueIn(world, builder, "balls.vx"), (2.0 * 3.0 + 6.0 * 1.0) / 8.0);
  EXPECT_EQ(valueIn(world, builder, "balls.momentum"), std::sqrt(12.0 * 12.0 + 8.0 * 8.0));
  EXPECT_EQ(valueIn(world, builder, "balls.kinetic"), 25.0 + 3.0);
  EXPECT_EQ(valueIn(world, builder, "boxes.y"), 40.0) << "of a rectangle's centre";
  EXPECT_EQ(valueIn(world, builder, "count"), 3.0);
  EXPECT_EQ(valueIn(world, builder, "kinetic"), 25.0 + 3.0 + 24.5);
  EXPECT_EQ(valueIn(world, builder, "energy"),
            valueIn(world, builder, "kinetic") + valueIn(world, builder, "potential"));
}

TEST(Probe, TimeAndFrameFollowTheClock) {
  World world(setupOfThree());
  const SceneBuilder builder = namesOfThree();
  EXPECT_EQ(valueIn(world, builder, "t"), 0.0);
  world.step({1, 0.25, 0.25});
  EXPECT_EQ(valueIn(world, builder, "t"), 0.25);
  EXPECT_EQ(valueIn(world, builder, "frame"), 1.0);
}

TEST(Probe, OfABodyThatIsNotThereIsNoNumber) {
  const World world(setupOfThree());
  const SceneBuilder builder = namesOfThree();
  EXPECT_EQ(valueIn(world, builder, "#77.count"), 0.0);
  for (const char* name : {"#77.x", "#77.speed", "#77.energy", "#77.error(ball)", "ball.error(#77)"})
    EXPECT_TRUE(std::isnan(valueIn(world, builder, name))) << name;
  SceneBuilder empty = namesOfThree();
  empty.addGroup("nobody");
  EXPECT_EQ(valueIn(world, empty, "nobody.count"), 0.0);
  EXPECT_EQ(valueIn(world, empty, "nobody.energy"), 0.0);
  EXPECT_TRUE(std::isnan(valueIn(world, empty, "nobody.x"))) << "no mass has no centre";
}

TEST(Probe, AFixedBodyHasNoEnergyAndNoMomentum) {
  WorldSetup setup = setupOfThree();
  setup.bodies[0].fixed = true;
  const World world(setup);
  const SceneBuilder builder = namesOfThree();
  EXPECT_EQ(valueIn(world, builder, "ball.energy"), 0.0);
  EXPECT_EQ(valueIn(world, builder, "ball.momentum"), 0.0);
  EXPECT_EQ(valueIn(world, builder, "balls.x"), 103.0);
  EXPECT_EQ(valueIn(world, builder, "balls.count"), 2.0);
}

/// The largest change of the whole energy over two seconds, as a share of the largest kinetic energy.
double energyDrift(const WorldSetup& setup) {
  World world(setup);
  const SceneBuilder builder = namesOfThree();
  const double start = valueIn(world, builder, "energy");
  double drift = 0.0;
  double kinetic = 0.0;
  for (std::int64_t frame = 1; frame <= 2000; ++frame) {
    world.step({frame, static_cast<double>(frame) / 1000.0, 0.001});
    drift = std::max(drift, std::abs(valueIn(world, builder, "energy") - start));
    kinetic = std::max(kinetic, valueIn(world, builder, "kinetic"));
  }
  return drift / kinetic;
}

/// With RK4 at a millisecond's step the method's own error is far below this.
constexpr double kConserved = 1e-9;

TEST(Probe, EnergyIsConservedUnderGravityAndABodysOwnAcceleration) {
  WorldSetup setup = setupOfThree();
  setup.gravity = {3.0, 50.0};
  setup.bodies[0].acceleration = {-20.0, 7.0};
  setup.bodies[1].feelsGravity = false;
  for (Body& body : setup.bodies) body.integrator = Integrator::Rk4;
  EXPECT_LT(energyDrift(setup), kConserved);
}

TEST(Probe, EnergyIsConservedUnderSpringsBetweenBodiesAndToAPoint) {
  WorldSetup setup = setupOfThree();
  addForce(setup, {SpringForce{.to = {Vec2::Zero(), 1U}, .stiffness = 40.0, .length = 30.0}, {}, 0U});
  addForce(setup, {SpringForce{.to = {Vec2(300, 200), {}}, .stiffness = 5.0}, {}, 2U});
  for (Body& body : setup.bodies) body.integrator = Integrator::Rk4;
  EXPECT_LT(energyDrift(setup), kConserved);
}

TEST(Probe, EnergyIsConservedUnderAnAttraction) {
  WorldSetup setup = setupOfThree();
  setup.gravity = Vec2::Zero();
  setup.bodies[0].velocity = {0.0, 60.0};
  addForce(setup, {AttractForce{.to = {Vec2(200, 80), {}}, .strength = 4e5, .softening = 2.0}, {}, 0U});
  for (Body& body : setup.bodies) body.integrator = Integrator::Rk4;
  EXPECT_LT(energyDrift(setup), kConserved);
}

TEST(Probe, IsInTheScenesUnitsUnderAView) {
  const World world(setupOfThree());
  SceneBuilder builder = namesOfThree();
  builder.view = View(100.0, Vec2(50.0, 480.0), true);
  EXPECT_EQ(valueIn(world, builder, "ball.x"), 0.5);
  EXPECT_EQ(valueIn(world, builder, "ball.y"), 4.0);
  EXPECT_EQ(valueIn(world, builder, "ball.vy"), 0.04);
  EXPECT_EQ(valueIn(world, builder, "ball.speed"), 0.05);
  EXPECT_EQ(valueIn(world, builder, "ball.error(exact)"), 0.05);
  EXPECT_DOUBLE_EQ(valueIn(world, builder, "ball.potential"), 2.0 * 0.1 * 4.0);
  EXPECT_EQ(findProbe(builder, "ball.vy").unit, "m/s");
  EXPECT_EQ(findProbe(namesOfThree(), "ball.vy").unit, "px/s");
  EXPECT_EQ(findProbe(builder, "balls.count").unit, "");
}

TEST(ProbeName, AWrongOneSaysWhatIsWrongAndTheNearestValidOne) {
  const SceneBuilder builder = namesOfThree();
  EXPECT_EQ(problemOf(builder, ""), "it is empty");
  EXPECT_EQ(problemOf(builder, "enrgy"), R"("enrgy" is not known; did you mean "energy"?)");
  EXPECT_EQ(problemOf(builder, "zzzzzzz"),
            "\"zzzzzzz\" is not known; allowed are t, frame, momentum, kinetic, "
            "potential, energy, count and NAME.QUANTITY");
  EXPECT_EQ(problemOf(builder, "ball"), R"("ball" lacks a quantity, such as "ball.speed")");
  EXPECT_EQ(problemOf(builder, "speed"),
            R"("speed" needs a body or a group before it, such as "ball.speed")");
  EXPECT_EQ(problemOf(builder, "bal.speed"),
            R"(there is no body and no group "bal"; did you mean "ball.speed"?)");
  EXPECT_EQ(problemOf(builder, "ball.sped"),
            R"("sped" is no quantity of a body; did you mean "ball.speed"?)");
  EXPECT_EQ(
      problemOf(builder, "ball.colour"),
      "\"colour\" is no quantity of a body; allowed are x, y, vx, vy, speed, px, py, momentum, kinetic, "
      "potential, energy, count, error(OTHER)");
  EXPECT_EQ(problemOf(builder, "ball.error"),
            "an error is written as \"NAME.error(OTHER)\", with the body that it is held against");
  EXPECT_EQ(problemOf(builder, "ball.error(exac)"), R"(there is no body "exac"; did you mean "exact"?)");
  EXPECT_EQ(problemOf(builder, "balls.error(exact)"),
            R"("balls" is a group, and an error is of one body against another)");
  EXPECT_EQ(problemOf(builder, "#x.y"), R"(there is no body and no group "#x")");
  EXPECT_EQ(problemOf(builder, "#99999999999.y"), R"(there is no body and no group "#99999999999")");
}

TEST(ProbeName, ABodyAndAGroupOfOneNameAreAmbiguous) {
  SceneBuilder builder = namesOfThree();
  builder.bodies.emplace("boxes", 2);
  EXPECT_EQ(problemOf(builder, "boxes.x"), "\"boxes\" is both a body and a group; the body alone is \"#2\"");
}

TEST(ProbeName, ANameMayHoldDots) {
  SceneBuilder builder = namesOfThree();
  builder.bodies.emplace("v1.0", 2);
  EXPECT_EQ(findProbe(builder, "v1.0.x").probe.body, 2U);
  EXPECT_EQ(findProbe(builder, "ball.error(v1.0)").probe.other, 2U);
}

} // namespace
} // namespace offstage::test
