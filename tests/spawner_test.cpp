#include "src/sim/random.h"
#include "src/sim/world.h"

#include <vector>

#include <gtest/gtest.h>

namespace offstage {
namespace {

Spawner everySecond() {
  Spawner spawner;
  spawner.x = ConstantNumber{100.0};
  spawner.y = ConstantNumber{100.0};
  spawner.radius = ConstantNumber{5.0};
  spawner.looks = {0};
  return spawner;
}

WorldSetup setupWith(const Spawner& spawner) {
  WorldSetup setup;
  setup.seed = 2022;
  setup.gravity = Vec2::Zero();
  setup.spawners = {spawner};
  return setup;
}

World run(const WorldSetup& setup, double fps, std::int64_t frames) {
  const Clock clock = Clock::fixed(fps, frames);
  World world(setup);
  for (std::int64_t frame = 1; frame <= frames; ++frame) world.step(clock.tick(frame));
  return world;
}

TEST(Spawner, MakesABodyWhenTheTimeHasPassedTheCount) {
  for (const auto& [frames, bodies] :
       std::vector<std::pair<int, std::size_t>>{{9, 0}, {10, 1}, {19, 1}, {20, 2}}) {
    EXPECT_EQ(run(setupWith(everySecond()), 10, frames).bodies().size(), bodies)
        << "after " << frames << " frames";
  }
}

TEST(Spawner, MakesAtMostOneBodyAFrame) {
  const World world = run(setupWith(everySecond()), 0.1, 3); // 10 s a frame
  EXPECT_EQ(world.bodies().size(), 3U);
}

TEST(Spawner, StopsAtItsLimit) {
  Spawner spawner = everySecond();
  spawner.limit = 2;
  EXPECT_EQ(run(setupWith(spawner), 10, 100).bodies().size(), 2U);
}

TEST(Spawner, CountsThoseOfItsOwnThatLive) {
  Spawner spawner = everySecond();
  spawner.count = Spawner::Count::Alive;
  spawner.prototype.removedOutside = true;
  spawner.vx = ConstantNumber{-1e6}; // gone in the step in which they are made
  WorldSetup setup = setupWith(spawner);
  setup.bodies.resize(5); // others do not count
  int spawned = 0;
  World world(setup);
  const Clock clock = Clock::fixed(10, 20);
  for (std::int64_t frame = 1; frame <= 20; ++frame) {
    world.step(clock.tick(frame));
    for (const Event& event : world.events()) spawned += event.kind == EventKind::Spawn ? 1 : 0;
  }
  EXPECT_EQ(spawned, 11) << "one in each of the frames 10 to 20";
}

TEST(Spawner, BeforeUpdateItsBodyMovesInItsFirstFrameAndAfterUpdateItDoesNot) {
  Spawner spawner = everySecond();
  spawner.vx = ConstantNumber{50.0};
  EXPECT_EQ(run(setupWith(spawner), 10, 10).bodies()[0].position.x(), 100.0 + 50.0 * (1.0 / 10.0));
  spawner.when = Spawner::When::AfterUpdate;
  EXPECT_EQ(run(setupWith(spawner), 10, 10).bodies()[0].position.x(), 100.0);
  EXPECT_EQ(run(setupWith(spawner), 10, 11).bodies()[0].position.x(), 100.0 + 50.0 * (1.0 / 10.0));
}

TEST(Spawner, DrawsItsFieldsInTheDocumentedOrder) {
  Spawner spawner = everySecond();
  spawner.prototype.shape = Shape::Rectangle;
  spawner.x = IntegerNumber{640};
  spawner.y = UniformNumber{10.0, 20.0};
  spawner.radius = IntegerNumber{9}; // drawn, though a rectangle has none
  spawner.width = GaussianNumber{40.0, 5.0};
  spawner.height = UniformNumber{1.0, 2.0};
  spawner.vx = SpreadNumber{120.0};
  spawner.vy = SpreadNumber{60.0};
  spawner.ax = IntegerNumber{7};
  spawner.ay = UniformNumber{-1.0, 1.0};
  spawner.mass = UniformNumber{1.0, 3.0};
  spawner.restitution = UniformNumber{0.5, 1.0};
  spawner.friction = GaussianNumber{2.0, 0.25};
  spawner.when = Spawner::When::AfterUpdate;
  const World world = run(setupWith(spawner), 1, 2);
  Random random(2022);
  for (int n = 0; n < 2; ++n) {
    const double x = random.nextInt(640);
    const double y = 10.0 + random.nextDouble() * (20.0 - 10.0);
    random.nextInt(9);
    const double width = 40.0 + random.nextGaussian() * 5.0;
    const double height = 1.0 + random.nextDouble() * (2.0 - 1.0);
    const double vx = (random.nextDouble() * 2.0 - 1.0) * 120.0;
    const double vy = (random.nextDouble() * 2.0 - 1.0) * 60.0;
    const double ax = random.nextInt(7);
    const double ay = -1.0 + random.nextDouble() * (1.0 - -1.0);
    const double mass = 1.0 + random.nextDouble() * (3.0 - 1.0);
    const double restitution = 0.5 + random.nextDouble() * (1.0 - 0.5);
    const double friction = 2.0 + random.nextGaussian() * 0.25;
    if (n == 0) continue; // the first has moved since; the second was made after the last update
    const Body& body = world.bodies()[1];
    EXPECT_EQ(body.position, Vec2(x, y));
    EXPECT_EQ(body.size, Vec2(width, height));
    EXPECT_EQ(body.radius, 0.0);
    EXPECT_EQ(body.velocity, Vec2(vx, vy));
    EXPECT_EQ(body.acceleration, Vec2(ax, ay));
    EXPECT_EQ(body.mass, mass);
    EXPECT_EQ(body.restitution, restitution);
    EXPECT_EQ(body.friction, friction);
  }
}

TEST(Spawner, ImpossibleDrawsBecomeTheSmallestPossible) {
  Spawner spawner = everySecond();
  spawner.radius = ConstantNumber{-3.0};
  spawner.mass = ConstantNumber{0.0};
  spawner.restitution = ConstantNumber{1.5};
  spawner.friction = ConstantNumber{-1.0};
  const World world = run(setupWith(spawner), 1, 1);
  EXPECT_EQ(world.bodies()[0].radius, 0.0);
  EXPECT_EQ(world.bodies()[0].mass, 1e-9);
  EXPECT_EQ(world.bodies()[0].restitution, 1.0);
  EXPECT_EQ(world.bodies()[0].friction, 0.0);
}

TEST(Spawner, GivesItsLooksInTurnAndItsNumberToItsBodies) {
  Spawner spawner = everySecond();
  spawner.looks = {4, 7};
  const World world = run(setupWith(spawner), 1, 3);
  ASSERT_EQ(world.bodies().size(), 3U);
  EXPECT_EQ(world.bodies()[0].look, 4U);
  EXPECT_EQ(world.bodies()[1].look, 7U);
  EXPECT_EQ(world.bodies()[2].look, 4U);
  EXPECT_EQ(world.bodies()[2].spawner, 0U);
  EXPECT_EQ(world.bodies()[2].id, 2U);
}

TEST(Spawner, ExactBodiesStartAtTheirFirstStep) {
  for (const auto when : {Spawner::When::BeforeUpdate, Spawner::When::AfterUpdate}) {
    Spawner spawner = everySecond();
    spawner.when = when;
    spawner.vx = ConstantNumber{50.0};
    spawner.prototype.integrator = Integrator::Exact;
    WorldSetup setup = setupWith(spawner);
    setup.gravity = Vec2(0, 10);
    const World world = run(setup, 10, 15);
    const double t = when == Spawner::When::BeforeUpdate ? 0.6 : 0.5;
    EXPECT_NEAR(world.bodies()[0].position.x(), 100.0 + 50.0 * t, 1e-12);
    EXPECT_NEAR(world.bodies()[0].position.y(), 100.0 + 5.0 * t * t, 1e-12);
  }
}

} // namespace
} // namespace offstage
