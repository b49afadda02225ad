#include "src/sim/error.h"
#include "src/sim/strict_math.h"
#include "src/sim/world.h"
#include "tests/support/sim_setup.h"

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// A bit of everything: what copies, forks and processors have to agree on.
WorldSetup crowd() {
  WorldSetup setup;
  setup.seed = 42;
  setup.substeps = 2;
  setup.groups = {"balls", "shots", "boxes"};
  setup.walls.restitution.fill(0.9);
  for (int i = 0; i < 5; ++i) {
    Body body = circle(100 + 90 * i, 100, 15, Vec2(40 - 17 * i, 10 * i));
    body.integrator = static_cast<Integrator>(i);
    setup.bodies.push_back(body);
  }
  Body box = rectangle(250, 300, 120, 30);
  box.fixed = true;
  box.group = 2;
  setup.bodies.push_back(box);
  addForce(setup, {DragForce{.linear = 0.05, .quadratic = 0.001}, 0U, {}});
  addForce(setup,
           {SpringForce{.to = {Vec2::Zero(), 1U}, .stiffness = 4.0, .length = 60.0, .damping = 0.1}, {}, 0U});
  addForce(setup,
           {CustomForce{[](const ForceState& s) { return Vec2(20.0 * strict::sin(s.time), 0.0); }}, 0U, {}});
  setup.contacts = {{.groupA = 0, .groupB = 0, .restitution = 0.95},
                    {.groupA = 0, .groupB = 2},
                    {.groupA = 1, .groupB = 0, .response = Response::RemoveImmediately}};
  Spawner spawner;
  spawner.every = 0.4;
  spawner.x = IntegerNumber{640};
  spawner.y = IntegerNumber{480};
  spawner.radius = IntegerNumber{20};
  spawner.vx = GaussianNumber{0.0, 60.0};
  spawner.looks = {0};
  setup.spawners = {spawner};
  Launch launch;
  launch.moments = {{std::nullopt, 1.0}, {90, 0.0}, {140, 0.0}};
  launch.from.point = Vec2(20, 460);
  launch.toward.body = 2U;
  launch.speed = 400.0;
  launch.prototype.radius = 4.0;
  launch.prototype.group = 1;
  launch.prototype.integrator = Integrator::Exact;
  launch.prototype.removedOutside = true;
  setup.launches = {launch};
  return setup;
}

TEST(World, CopyGoesOnWithTheSameBits) {
  const Clock clock = Clock::fixed(60, 300);
  World world(crowd());
  std::vector<std::uint64_t> hashes;
  for (std::int64_t frame = 1; frame <= 150; ++frame) world.step(clock.tick(frame));
  World copy = world;
  for (std::int64_t frame = 151; frame <= 300; ++frame) {
    world.step(clock.tick(frame));
    hashes.push_back(world.stateHash());
  }
  for (std::int64_t frame = 151; frame <= 300; ++frame) {
    copy.step(clock.tick(frame));
    ASSERT_EQ(copy.stateHash(), hashes[static_cast<std::size_t>(frame - 151)]) << "frame " << frame;
    EXPECT_EQ(copy.frame(), frame);
  }
  EXPECT_GT(copy.bodies().size(), 6U);
}

TEST(World, CrowdHasThePinnedStateHash) {
  // The bits of every machine, compiler and optimisation level. A change here is a change of the physics.
  const Clock clock = Clock::fixed(60, 300);
  World world(crowd());
  for (std::int64_t frame = 1; frame <= 300; ++frame) world.step(clock.tick(frame));
  EXPECT_EQ(world.stateHash(), 0xf6fe421af1b0743cULL);
}

TEST(World, SubstepsAreShorterStepsOfTheSameFrame) {
  WorldSetup coarse;
  coarse.bodies = {circle(320, 60, 20, Vec2(30, 0))};
  coarse.walls.restitution.fill(0.8);
  coarse.gravity = Vec2(0, 900);
  addForce(coarse, {CustomForce{[](const ForceState& s) { return Vec2(100.0 * s.time, 0.0); }}, {}, {}});
  WorldSetup fine = coarse;
  coarse.substeps = 4;
  World a(coarse);
  World b(fine);
  std::size_t bounces = 0;
  for (int frame = 1; frame <= 64; ++frame) {
    a.step({frame, frame / 16.0, 1.0 / 16.0}); // powers of two: no rounding in the times
    for (int j = 1; j <= 4; ++j) {
      const int small = 4 * (frame - 1) + j;
      b.step({small, small / 64.0, 1.0 / 64.0});
    }
    for (const Event& event : a.events()) {
      ++bounces;
      EXPECT_EQ(event.frame, frame);
      EXPECT_EQ(event.time, frame / 16.0);
    }
    ASSERT_EQ(a.bodies()[0].position, b.bodies()[0].position) << "frame " << frame;
    ASSERT_EQ(a.bodies()[0].velocity, b.bodies()[0].velocity) << "frame " << frame;
  }
  EXPECT_GT(bounces, 3U);
}

TEST(World, FixedBodyNeverMovesAndStillCollides) {
  WorldSetup setup;
  Body peg = circle(320, 200, 20, Vec2(7, 7));
  peg.fixed = true;
  peg.integrator = Integrator::Exact;
  setup.bodies = {peg, circle(320, 100, 10)};
  setup.walls.restitution.fill(1.0);
  setup.gravity = Vec2(0, 200);
  setup.contacts = {{}};
  addForce(setup, {DragForce{.linear = 0.1}, {}, {}});
  World world(setup);
  int hits = 0;
  for (int frame = 1; frame <= 300; ++frame) {
    world.step({frame, frame / 60.0, 1.0 / 60.0});
    for (const Event& event : world.events()) hits += event.kind == EventKind::Collide ? 1 : 0;
    ASSERT_EQ(world.bodies()[0].position, Vec2(320, 200));
    ASSERT_LT(world.bodies()[1].position.y(), 175.0) << "the ball has fallen through the peg";
  }
  EXPECT_GE(hits, 2);
}

TEST(World, RectangleBouncesOffTheWallsWithItsSides) {
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  setup.bodies = {rectangle(590, 430, 40, 30, Vec2(100, 200))};
  setup.walls.restitution = {0.5, 0.5, 0.5, 0.25};
  World world(setup);
  world.step({1, 0.125, 0.125});
  EXPECT_EQ(world.bodies()[0].position, Vec2(600, 450));
  EXPECT_EQ(world.bodies()[0].velocity, Vec2(-50, -50));
  ASSERT_EQ(world.events().size(), 2U);
  EXPECT_EQ(world.events()[0].kind, EventKind::Right);
  EXPECT_EQ(world.events()[0].p, 602.5);
  EXPECT_EQ(world.events()[0].q, 100.0);
  EXPECT_EQ(world.events()[1].kind, EventKind::Bottom);
}

TEST(World, WithoutClampWhoeverTouchesFlipsAndNothingIsMoved) {
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  setup.walls.restitution.fill(0.5);
  setup.walls.clamp = false;
  setup.bodies = {circle(5, 240, 10, Vec2(8, 0))}; // moving inwards
  World world(setup);
  world.step({1, 0.125, 0.125});
  EXPECT_EQ(world.bodies()[0].position.x(), 6.0);
  EXPECT_EQ(world.bodies()[0].velocity.x(), -4.0);
}

TEST(World, BodiesWhollyOutsideThePaneGoAndTheOthersKeepTheirOrder) {
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  setup.bodies = {circle(100, 100, 10),      circle(-10, 100, 10),    circle(-10.5, 100, 10),
                  rectangle(-30, 0, 20, 20), rectangle(640, 0, 5, 5), circle(100, 491, 10),
                  circle(100, 300, 10)};
  for (Body& body : setup.bodies) body.removedOutside = true;
  setup.bodies[6].removedOutside = false;
  setup.bodies[6].position = Vec2(-500, -500);
  World world(setup);
  world.step({1, 0.1, 0.1});
  std::vector<std::uint32_t> ids;
  for (const Body& body : world.bodies()) ids.push_back(body.id);
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{0, 1, 4, 6})) << "touching the edge from outside is not outside";
  EXPECT_EQ(world.find(2), nullptr);
  ASSERT_NE(world.find(4), nullptr);
  EXPECT_EQ(world.find(4)->shape, Shape::Rectangle);
  EXPECT_EQ(world.find(99), nullptr);
  ASSERT_EQ(world.events().size(), 3U);
  EXPECT_EQ(world.events()[0].kind, EventKind::Leave);
  EXPECT_EQ(world.events()[0].first, 2);
  EXPECT_EQ(world.events()[0].p, -10.5);
}

TEST(World, MarkedBodiesTouchEverybodyAndThoseRemovedAtOnceNobodyElse) {
  for (const Response response : {Response::Remove, Response::RemoveImmediately}) {
    WorldSetup setup;
    setup.gravity = Vec2::Zero();
    setup.bodies = {circle(300, 300, 20), circle(335, 300, 20),
                    circle(370, 300, 20)}; // the middle touches both
    setup.contacts = {{.response = response}};
    World world(setup);
    world.step({1, 0.1, 0.1});
    const bool marked = response == Response::Remove;
    EXPECT_EQ(world.bodies().size(), marked ? 0U : 1U);
    EXPECT_EQ(world.events().size(), marked ? 2U : 1U);
    if (!marked) {
      EXPECT_EQ(world.bodies()[0].id, 2U);
    }
  }
}

TEST(World, IdsAreGivenInOrderOfCreationToBodiesLaunchesAndSpawns) {
  WorldSetup setup = crowd();
  setup.bodies[3].id = 77; // whatever is set
  World world(setup);
  EXPECT_EQ(world.bodies()[3].id, 3U);
  const Clock clock = Clock::fixed(60, 300);
  std::int64_t next = 6;
  for (std::int64_t frame = 1; frame <= 300; ++frame) {
    world.step(clock.tick(frame));
    for (const Event& event : world.events()) {
      if (event.kind != EventKind::Spawn && event.kind != EventKind::Fire) continue;
      EXPECT_EQ(event.first, next++);
    }
  }
  EXPECT_EQ(next, 6 + 12 + 3);
}

TEST(World, RefusesATickThatDoesNotFollow) {
  World world(WorldSetup{});
  EXPECT_THROW(world.step({2, 0.1, 0.1}), std::invalid_argument);
  world.step({1, 0.1, 0.1});
  EXPECT_THROW(world.step({1, 0.1, 0.1}), std::invalid_argument);
}

TEST(World, SurvivesStatesThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  WorldSetup setup = crowd();
  setup.bodies.push_back(circle(nan, 100, 15));
  setup.bodies.push_back(circle(infinity, -infinity, 15, Vec2(nan, infinity)));
  setup.bodies.push_back(circle(1e308, 1e308, 1e308, Vec2(1e308, 1e308)));
  setup.bodies.push_back(rectangle(nan, infinity, 10, 10));
  setup.bodies.push_back(circle(100, 100, 15, Vec2(nan, nan)));
  setup.bodies.back().integrator = Integrator::Exact;
  setup.bodies.back().group = 2;
  World world(setup);
  for (int frame = 1; frame <= 100; ++frame) world.step({frame, frame / 60.0, 1.0 / 60.0});
  world.step({101, infinity, nan});
  world.step({102, nan, -1.0});
  EXPECT_EQ(world.frame(), 102);
  EXPECT_NE(world.stateHash(), 0U);
}

TEST(World, RefusesSetupsThatCannotBeSimulated) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<std::string, std::function<void(WorldSetup&)>>> broken{
      {"substeps: there must be at least 1", [](WorldSetup& s) { s.substeps = 0; }},
      {"pane: its size", [](WorldSetup& s) { s.pane.x() = -1.0; }},
      {"body 2: group 9 does not exist; there are 3", [](WorldSetup& s) { s.bodies[2].group = 9; }},
      {"body 0: the radius", [](WorldSetup& s) { s.bodies[0].radius = -1.0; }},
      {"body 0: the radius", [nan](WorldSetup& s) { s.bodies[0].radius = nan; }},
      {"body 5: the size", [](WorldSetup& s) { s.bodies[5].size.y() = -0.5; }},
      {"body 1: the mass", [](WorldSetup& s) { s.bodies[1].mass = 0.0; }},
      {"force 0: drag", [](WorldSetup& s) { std::get<DragForce>(s.forces[0].kind).linear = -1.0; }},
      {"force 1: a spring",
       [nan](WorldSetup& s) { std::get<SpringForce>(s.forces[1].kind).stiffness = nan; }},
      {"force 2: a custom force needs", [](WorldSetup& s) { s.forces[2].kind = CustomForce{}; }},
      {"force 0: an attraction",
       [nan](WorldSetup& s) { s.forces[0].kind = AttractForce{.to = {}, .strength = nan}; }},
      {"force 0: a wind",
       [](WorldSetup& s) {
         s.forces[0].kind = WindForce{Vec2(1, 1), -1.0};
       }},
      {"force 0: group 3", [](WorldSetup& s) { s.forces[0].group = 3; }},
      {"contact rule 1: there is a rule", [](WorldSetup& s) { s.contacts[1] = {.groupA = 0, .groupB = 0}; }},
      {"contact rule 2: there is a rule", [](WorldSetup& s) { s.contacts[2] = {.groupA = 2, .groupB = 0}; }},
      {"contact rule 0: the restitution", [](WorldSetup& s) { s.contacts[0].restitution = 1.5; }},
      {"contact rule 0: group 5", [](WorldSetup& s) { s.contacts[0].groupB = 5; }},
      {"spawner 0: the time", [](WorldSetup& s) { s.spawners[0].every = 0.0; }},
      {"spawner 0: it needs at least one look", [](WorldSetup& s) { s.spawners[0].looks.clear(); }},
      {"spawner 0: the bound", [](WorldSetup& s) { s.spawners[0].ay = IntegerNumber{0}; }},
      {"spawner 0: group 3", [](WorldSetup& s) { s.spawners[0].prototype.group = 3; }},
      {"spawner 0: no closed form for the integrator exact: several forces",
       [](WorldSetup& s) {
         s.spawners[0].prototype.integrator = Integrator::Exact;
         addForce(s, {WindForce{Vec2(1, 1), 1.0}, {}, {}});
         s.forces[0].kind = SpringForce{.to = {}, .stiffness = 1.0};
       }},
      {"launch 0: the speed", [](WorldSetup& s) { s.launches[0].speed = -1.0; }},
      {"launch 0: its frame", [](WorldSetup& s) { s.launches[0].moments[1].frame = 0; }},
      {"launch 0: no closed form for the integrator exact: drag",
       [](WorldSetup& s) { s.forces[0].group.reset(); }}};
  for (const auto& [message, breakIt] : broken) {
    WorldSetup setup = crowd();
    breakIt(setup);
    try {
      const World world(setup);
      ADD_FAILURE() << "no error: " << message;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::BadInput);
      EXPECT_EQ(std::string(error.what()).find(message), 0U) << error.what() << " instead of " << message;
    }
  }
}

TEST(World, EventNamesAreThoseOfTheReference) {
  EXPECT_EQ(name(EventKind::Spawn), "spawn");
  EXPECT_EQ(name(EventKind::NoFire), "nofire");
  EXPECT_EQ(name(EventKind::Bottom), "bottom");
  EXPECT_EQ(name(EventKind::Collide), "collide");
  EXPECT_EQ(name(EventKind::Leave), "leave");
}

} // namespace
} // namespace offstage::test
