// What a step costs as worlds grow: no allocation once everything has its size, no work for bodies that are
// gone.
#include "src/sim/world.h"
#include "tests/support/allocation_count.h"
#include "tests/support/sim_setup.h"

#include <cmath>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// Circles of three sizes and some bricks in a closed pane, which bounce off each other.
WorldSetup crowd(int count) {
  WorldSetup setup;
  setup.pane = Vec2(900, 700);
  setup.gravity = Vec2(0, 300);
  setup.walls.restitution.fill(0.8);
  setup.contacts = {{.restitution = 0.8}};
  for (int i = 0; i < count; ++i) {
    const double x = 20.0 + 17.0 * (i % 50);
    const double y = 20.0 + 17.0 * (i / 50);
    const Vec2 velocity(37.0 * (i % 7) - 100.0, 29.0 * (i % 5) - 60.0);
    setup.bodies.push_back(i % 9 == 0 ? rectangle(x, y, 12, 9, velocity)
                                      : circle(x, y, 4.0 + i % 3, velocity));
  }
  return setup;
}

TEST(WorldScale, StepDoesNotAllocateAfterWarmUp) {
  World world(crowd(1000));
  const Clock clock = Clock::fixed(60, 400);
  while (world.frame() < 200) world.step(clock.tick(world.frame() + 1));
  if (!allocationsSinceLastCall()) GTEST_SKIP() << "the sanitizer's own operator new does not count";
  while (world.frame() < 400) world.step(clock.tick(world.frame() + 1));
  EXPECT_EQ(allocationsSinceLastCall(), 0U) << "in 200 steps";
}

TEST(WorldScale, SpawnerCountsThoseThatLiveWhateverTookTheOthersAway) {
  WorldSetup setup;
  setup.gravity = Vec2(0, 900);
  setup.contacts = {{.response = Response::RemoveImmediately}};
  Spawner drops;
  drops.every = 1.0 / 60.0;
  drops.count = Spawner::Count::Alive;
  drops.prototype.removedOutside = true;
  drops.x = IntegerNumber{640};
  drops.y = IntegerNumber{480};
  drops.radius = ConstantNumber{12.0};
  drops.looks = {0};
  setup.spawners = {drops};
  World world(setup);
  int hits = 0;
  int left = 0;
  for (int frame = 1; frame <= 300; ++frame) {
    const auto before = static_cast<double>(world.bodies().size());
    const double time = frame / 60.0;
    world.step({frame, time, 1.0 / 60.0});
    int spawned = 0;
    for (const Event& event : world.events()) {
      spawned += event.kind == EventKind::Spawn ? 1 : 0;
      hits += event.kind == EventKind::Hit ? 1 : 0;
      left += event.kind == EventKind::Leave ? 1 : 0;
    }
    ASSERT_EQ(spawned, std::floor(time / drops.every) > before ? 1 : 0) << "frame " << frame;
  }
  EXPECT_GT(hits, 5);
  EXPECT_GT(left, 5);
}

} // namespace
} // namespace offstage::test
