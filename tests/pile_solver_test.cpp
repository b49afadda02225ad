#include "src/sim/random.h"
#include "src/sim/world.h"
#include "tests/support/allocation_count.h"
#include "tests/support/sim_setup.h"
#include "tests/support/workload_s.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

WorldSetup solverSetup(const Vec2& gravity) {
  WorldSetup setup;
  setup.gravity = gravity;
  setup.contactModel = ContactModel::Solver;
  setup.substeps = 4;
  setup.contacts = {{}};
  return setup;
}

void run(World& world, int frames) {
  const Clock clock = Clock::fixed(60, world.frame() + frames);
  while (world.frame() < clock.steps()) world.step(clock.tick(world.frame() + 1));
}

struct Overlaps {
  double mean = 0.0, worst = 0.0; ///< in radii
};

Overlaps overlapsOf(const World& world) {
  Overlaps overlaps;
  int count = 0;
  const auto bodies = world.bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      const double touch = bodies[i].radius + bodies[j].radius;
      const double overlap = (touch - length(bodies[j].position - bodies[i].position)) / bodies[i].radius;
      if (!(overlap > 0.0)) continue;
      overlaps.worst = std::max(overlaps.worst, overlap);
      overlaps.mean += overlap;
      ++count;
    }
  }
  overlaps.mean /= std::max(count, 1);
  return overlaps;
}

/// Per unit of mass; heights from the lower edge.
double energyOf(const World& world) {
  double sum = 0.0;
  for (const Body& body : world.bodies()) {
    sum += 0.5 * dot(body.velocity, body.velocity) +
           world.setup().gravity.y() * (world.setup().pane.y() - body.position.y());
  }
  return sum;
}

double fastest(const World& world) {
  double speed = 0.0;
  for (const Body& body : world.bodies()) speed = std::max(speed, length(body.velocity));
  return speed;
}

TEST(PileSolver, AThousandCirclesNeitherSinkNorBoil) {
  const WorkloadS workload(1000);
  World world(workload.setup);
  double before = energyOf(world);
  for (int second = 1; second <= 5; ++second) {
    run(world, 60);
    const double after = energyOf(world);
    EXPECT_LT(after, before * (1.0 + 1e-9)) << "energy after " << second << " s";
    before = after;
  }
  Overlaps overlaps = overlapsOf(world);
  EXPECT_LT(overlaps.mean, 0.02);
  EXPECT_LT(overlaps.worst, 0.6);
  run(world, 900);
  overlaps = overlapsOf(world);
  EXPECT_LT(overlaps.mean, 0.01) << "at rest";
  EXPECT_LT(overlaps.worst, 0.1) << "at rest";
  EXPECT_LT(fastest(world), 0.05) << "m/s, at rest; gravity gives 0.16 in a step";
  for (const Body& body : world.bodies()) {
    ASSERT_GE(body.position.x(), body.radius) << body.id;
    ASSERT_LE(body.position.x(), workload.side - body.radius) << body.id;
    ASSERT_LE(body.position.y(), workload.side - body.radius) << body.id;
  }
  run(world, 1);
  EXPECT_TRUE(world.events().empty()) << world.events().size() << " events in a pile at rest";
}

TEST(PileSolver, BallsOnTopOfEachOtherStayWhereTheyAre) {
  WorldSetup setup = solverSetup(Vec2(0, 900));
  setup.walls.restitution[3] = 0.5;
  for (int i = 0; i < 8; ++i) setup.bodies.push_back(circle(320, 470 - 20 * i, 10));
  World world(setup);
  run(world, 600);
  for (int i = 0; i < 8; ++i) {
    const Body& body = world.bodies()[static_cast<std::size_t>(i)];
    EXPECT_NEAR(body.position.y(), 470 - 20 * i, 0.02 * 10 * (i + 1)) << "ball " << i;
    EXPECT_EQ(body.position.x(), 320.0) << "nothing pushes sideways";
    EXPECT_LT(length(body.velocity), 1.0) << "ball " << i;
  }
}

TEST(PileSolver, StackedCratesStand) {
  WorldSetup setup = solverSetup(Vec2(0, 900));
  setup.walls.restitution[3] = 0.2;
  setup.bodies = {rectangle(100, 420, 440, 60)};
  setup.bodies[0].fixed = true;
  for (int i = 0; i < 6; ++i) setup.bodies.push_back(rectangle(300 + 3 * i, 380 - 40 * i, 40, 40));
  for (Body& body : setup.bodies) body.friction = 0.5;
  World world(setup);
  run(world, 600);
  for (int i = 0; i < 6; ++i) {
    const Body& body = world.bodies()[static_cast<std::size_t>(i) + 1];
    EXPECT_NEAR(body.position.y(), 380 - 40 * i, 0.5) << "crate " << i;
    EXPECT_NEAR(body.position.x(), 300 + 3 * i, 0.5) << "crate " << i;
  }
}

TEST(PileSolver, CollisionsGiveTheVelocitiesOfTheLawOfImpact) {
  for (const double e : {0.0, 0.4, 1.0}) {
    for (const bool fixed : {false, true}) {
      WorldSetup setup = solverSetup(Vec2::Zero());
      setup.contacts[0].restitution = e;
      setup.bodies = {circle(300, 200, 10, Vec2(120, 0), 2.0), circle(330, 200, 10, Vec2(-60, 0), 1.0)};
      setup.bodies[1].fixed = fixed;
      const Contact contact{Vec2(1, 0), 20.0, 20.0};
      std::vector<Body> expected = setup.bodies;
      respond(setup.contacts[0], contact, expected[0], expected[1]);
      World world(setup);
      run(world, 30);
      for (std::size_t i = 0; i < 2; ++i) {
        const Vec2 v = fixed && i == 1 ? Vec2(-60, 0) : expected[i].velocity;
        EXPECT_LT(length(world.bodies()[i].velocity - v), 1e-9)
            << "e " << e << ", fixed " << fixed << ", body " << i << ": "
            << world.bodies()[i].velocity.transpose();
      }
    }
  }
}

TEST(PileSolver, ElasticGasKeepsItsEnergyAndMomentum) {
  WorldSetup setup = solverSetup(Vec2::Zero());
  setup.walls.restitution.fill(1.0);
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const int row = i / 10;
    const double vx = random.nextGaussian() * 80.0;
    setup.bodies.push_back(
        circle(35 + 60 * (i % 10), 30 + 46 * row, 8, Vec2(vx, random.nextGaussian() * 80.0)));
  }
  World world(setup);
  const double before = energyOf(world);
  run(world, 600);
  EXPECT_NEAR(energyOf(world) / before, 1.0, 0.1) << "after thousands of collisions, many of three at once";
}

TEST(PileSolver, BallBouncesToTheRestitutionsSquareOfItsHeight) {
  WorldSetup setup = solverSetup(Vec2(0, 900));
  setup.walls.restitution[3] = 0.8;
  setup.bodies = {circle(320, 70, 10)}; // 400 px above where it hits
  World world(setup);
  double highest = 480.0;
  bool hit = false;
  for (int frame = 1; frame <= 130; ++frame) {
    run(world, 1);
    for (const Event& event : world.events()) {
      EXPECT_EQ(event.kind, EventKind::Bottom);
      hit = true;
    }
    if (hit) highest = std::min(highest, world.bodies()[0].position.y());
  }
  ASSERT_TRUE(hit);
  EXPECT_NEAR(470.0 - highest, 0.64 * 400.0, 0.06 * 256.0);
}

TEST(PileSolver, ReboundsRubAsTheLawOfImpactHasIt) {
  // Along the contact at most the friction times what the speed across changes by, rebound and all; with 3.0
  // the bodies stick.
  for (const double e : {0.0, 0.5, 1.0}) {
    for (const double friction : {0.0, 0.2, 3.0}) {
      WorldSetup setup = solverSetup(Vec2::Zero());
      setup.contacts[0].restitution = e;
      setup.bodies = {circle(300, 200, 10, Vec2(120, 90), 2.0), circle(330, 205, 10, Vec2(-60, 0), 1.0)};
      for (Body& body : setup.bodies) body.friction = friction;
      const Contact contact{Vec2(1, 0), 20.0, 20.0};
      std::vector<Body> expected = setup.bodies;
      respond(setup.contacts[0], contact, expected[0], expected[1]);
      // They come to touch side by side, 10 px at 180 px/s further.
      World world(setup);
      run(world, 6);
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_LT(length(world.bodies()[i].velocity - expected[i].velocity), 30.0)
            << "body " << i << ", restitution " << e << ", friction " << friction << ": "
            << world.bodies()[i].velocity.transpose() << " instead of " << expected[i].velocity.transpose();
      }

      WorldSetup atWall = solverSetup(Vec2::Zero());
      atWall.walls.restitution[3] = e;
      atWall.bodies = {circle(320, 465, 10, Vec2(100, 100), 2.0)};
      atWall.bodies[0].friction = friction;
      World room(atWall);
      run(room, 30);
      const Vec2 after(std::max(100.0 - friction * (1.0 + e) * 100.0, 0.0), -e * 100.0);
      EXPECT_LT(length(room.bodies()[0].velocity - after), 1e-6)
          << "restitution " << e << ", friction " << friction << ": " << room.bodies()[0].velocity.transpose()
          << " instead of " << after.transpose();
    }
  }
}

TEST(PileSolver, FrictionStopsASliderAfterItsWay) {
  // v²/(2·f·g), with the geometric mean of 0.9 and 0.4 against the block, and the body's own at the wall.
  for (const bool onBlock : {true, false}) {
    WorldSetup setup = solverSetup(Vec2(0, 900));
    setup.walls.restitution[3] = 0.3;
    setup.bodies = {rectangle(-2000, 440, 5000, 30),
                    rectangle(100, onBlock ? 420 : 460, 30, 20, Vec2(300, 0))};
    setup.bodies[0].fixed = true;
    setup.bodies[0].friction = 0.9;
    setup.bodies[1].friction = 0.4;
    if (!onBlock) setup.bodies.erase(setup.bodies.begin());
    World world(setup);
    run(world, 200);
    const Body& slider = world.bodies()[onBlock ? 1 : 0];
    const double way = 300.0 * 300.0 / (2.0 * (onBlock ? 0.6 : 0.4) * 900.0);
    EXPECT_NEAR(slider.position.x() - 100.0, way, 0.05 * way) << (onBlock ? "on a block" : "on the wall");
    EXPECT_LT(std::abs(slider.velocity.x()), 0.5);
  }
}

TEST(PileSolver, ContactIsReportedOnceAndOnlyWhenItBegins) {
  WorldSetup setup = solverSetup(Vec2(0, 900));
  setup.walls.restitution[3] = 0.0;
  setup.contacts[0].restitution = 0.0;
  setup.bodies = {circle(320, 470, 10), circle(320, 350, 10)};
  World world(setup);
  std::vector<Event> events;
  for (int frame = 0; frame < 200; ++frame) {
    run(world, 1);
    events.insert(events.end(), world.events().begin(), world.events().end());
  }
  ASSERT_EQ(events.size(), 1U) << "one fell onto the other, which lay there";
  EXPECT_EQ(events[0].kind, EventKind::Collide);
  EXPECT_EQ(events[0].first, 0);
  EXPECT_EQ(events[0].second, 1);
  EXPECT_NEAR(events[0].q, std::sqrt(2.0 * 900.0 * 100.0), 20.0) << "closing speed";
}

TEST(PileSolver, BodiesThatTouchNobodyMoveAsWithoutTheSolver) {
  for (const bool withForces : {false, true}) {
    WorldSetup setup = solverSetup(Vec2(3, 90));
    for (int i = 0; i < 5; ++i) {
      setup.bodies.push_back(circle(60 + 120 * i, 100, 10, Vec2(5 * i, 20)));
      if (withForces) setup.bodies.back().integrator = static_cast<Integrator>(i);
    }
    if (withForces) addForce(setup, {DragForce{.linear = 0.3}, {}, {}});
    WorldSetup plain = setup;
    plain.contactModel = ContactModel::Lecture;
    World a(setup);
    World b(plain);
    for (int frame = 0; frame < 60; ++frame) {
      run(a, 1);
      run(b, 1);
      ASSERT_EQ(a.stateHash(), b.stateHash()) << "frame " << a.frame() << (withForces ? " with forces" : "");
    }
  }
}

TEST(PileSolver, PileRestsUnderForcesAndAnyIntegrator) {
  for (const Integrator integrator : {Integrator::Rk4, Integrator::Verlet, Integrator::ExplicitEuler}) {
    WorldSetup setup = solverSetup(Vec2(0, 900));
    setup.walls.restitution.fill(0.3);
    for (int i = 0; i < 100; ++i) {
      const int row = i / 10;
      setup.bodies.push_back(circle(200 + 22 * (i % 10) + i % 3, 40 + 25 * row, 10));
      setup.bodies.back().integrator = integrator;
    }
    addForce(setup, {WindForce{Vec2(30, 0), 0.2}, {}, {}});
    World world(setup);
    run(world, 900);
    EXPECT_LT(fastest(world), 5.0) << static_cast<int>(integrator);
    EXPECT_LT(overlapsOf(world).worst, 0.1) << static_cast<int>(integrator);
  }
}

/// Piles, spawns, removals, a fixed body and a projectile.
WorldSetup busySetup() {
  WorldSetup setup = solverSetup(Vec2(0, 600));
  setup.groups = {"balls", "shots"};
  setup.contacts = {{.restitution = 0.4},
                    {.groupA = 0, .groupB = 1, .response = Response::RemoveImmediately}};
  setup.walls.restitution = {0.5, 0.5, std::nullopt, 0.5};
  setup.bodies = {circle(320, 300, 40)};
  setup.bodies[0].fixed = true;
  Spawner spawner;
  spawner.every = 1.0 / 60.0;
  spawner.x = IntegerNumber{640};
  spawner.y = ConstantNumber{-10.0};
  spawner.vy = ConstantNumber{200.0};
  spawner.radius = UniformNumber{4.0, 12.0};
  spawner.prototype.friction = 0.3;
  spawner.prototype.restitution = 0.7;
  spawner.looks = {0};
  setup.spawners = {spawner};
  Launch launch;
  for (int i = 1; i < 20; ++i) launch.moments.push_back({std::nullopt, 0.3 * i});
  launch.from.point = Vec2(10, 460);
  launch.toward.point = Vec2(630, 440);
  launch.speed = 500.0;
  launch.prototype.radius = 6.0;
  launch.prototype.group = 1;
  launch.prototype.removedOutside = true;
  setup.launches = {launch};
  return setup;
}

TEST(PileSolver, CopyGoesOnWithTheSameBitsThroughSpawnsAndRemovals) {
  World world(busySetup());
  run(world, 200);
  World copy = world;
  std::size_t hits = 0;
  for (int frame = 0; frame < 200; ++frame) {
    run(world, 1);
    run(copy, 1);
    for (const Event& event : world.events()) hits += event.kind == EventKind::Hit ? 1U : 0U;
    ASSERT_EQ(world.stateHash(), copy.stateHash()) << "frame " << world.frame();
  }
  EXPECT_GT(hits, 3U);
  EXPECT_GT(world.bodies().size(), 250U);
}

TEST(PileSolver, StepDoesNotAllocateAfterWarmUp) {
  World world(WorkloadS(500).setup);
  run(world, 300);
  const Clock clock = Clock::fixed(60, 500);
  if (!allocationsSinceLastCall()) GTEST_SKIP() << "the sanitizer's own operator new does not count";
  while (world.frame() < 500) world.step(clock.tick(world.frame() + 1));
  EXPECT_EQ(allocationsSinceLastCall(), 0U) << "in 200 steps";
}

/// From the first fall to the pile at rest, the state that a user reads included.
TEST(PileSolver, AWorldTakesFewerThan400BytesABody) {
  if (!bytesHeld()) GTEST_SKIP() << "the sanitizer's own operator new does not count";
  for (const int bodies : {1000, 4000}) {
    const WorkloadS workload(bodies);
    const std::ptrdiff_t before = *bytesHeld();
    World world(workload.setup);
    std::ptrdiff_t most = 0;
    const Clock clock = Clock::fixed(60, 300);
    while (world.frame() < 300) {
      world.step(clock.tick(world.frame() + 1));
      most = std::max(most, *bytesHeld() - before);
    }
    EXPECT_LT(static_cast<double>(most) / bodies, 400.0) << bodies << " bodies";
    EXPECT_GT(most, std::ptrdiff_t{sizeof(Body)} * bodies) << "is anything counted?";
  }
}

TEST(PileSolver, StepsWithoutLengthMoveNothingAndUnevenOnesKeepThePileAtRest) {
  WorldSetup setup = solverSetup(Vec2(0, 900));
  setup.walls.restitution[3] = 0.3;
  for (int i = 0; i < 5; ++i) setup.bodies.push_back(circle(320, 470 - 20 * i, 10));
  World world(setup);
  double time = 0.0;
  for (int frame = 1; frame <= 400; ++frame) {
    const double dt = frame % 7 == 0 ? 0.0 : frame % 5 == 0 ? 0.034 : 0.0166;
    const std::vector<Body> before(world.bodies().begin(), world.bodies().end());
    time += dt;
    world.step({frame, time, dt});
    if (dt == 0.0) {
      ASSERT_EQ(world.bodies()[4].position, before[4].position);
    }
  }
  EXPECT_NEAR(world.bodies()[4].position.y(), 390.0, 2.0);
}

TEST(PileSolver, SurvivesStatesThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  WorldSetup setup = busySetup();
  for (int i = 0; i < 20; ++i) setup.bodies.push_back(circle(300 + i, 100, 9));
  setup.bodies.push_back(circle(nan, 100, 15));
  setup.bodies.push_back(circle(infinity, -infinity, 15, Vec2(nan, infinity)));
  setup.bodies.push_back(circle(1e300, 1e300, 1e300, Vec2(1e300, 1e300)));
  setup.bodies.push_back(rectangle(nan, infinity, 10, 10));
  setup.bodies.push_back(circle(100, 100, 15, Vec2(nan, nan)));
  setup.bodies.push_back(circle(100, 100, 0, Vec2(1e200, 0)));
  World world(setup);
  run(world, 100);
  world.step({101, infinity, nan});
  world.step({102, nan, -1.0});
  EXPECT_EQ(world.frame(), 102);
  int whole = 0;
  for (const Body& body : world.bodies()) {
    whole += std::isfinite(body.position.x()) && std::isfinite(body.position.y()) ? 1 : 0;
  }
  EXPECT_GT(whole, 60) << "whoever has nothing to do with them stays whole";
}

TEST(PileSolver, WorkloadSHasThePinnedStateHash) {
  // The bits of every machine, compiler and optimisation level; tests/parity holds the others to it.
  World world(WorkloadS(400).setup);
  run(world, 300);
  EXPECT_EQ(world.stateHash(), 0xf56b29432c21d9bfULL);
}

} // namespace
} // namespace offstage::test
