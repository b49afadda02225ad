#include "src/sim/state_hash.h"
#include "src/sim/world.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace offstage {
namespace {

// Computed by hand from the definition in state_hash.h (FNV-1a over the packed bytes, in Python).
TEST(StateHash, IsFnv1aOverTheDocumentedBytes) {
  EXPECT_EQ(StateHash(0.0).value(), 0xa8c7f832281a39c5ULL);
  StateHash hash(0.5);
  hash.add(3, Shape::Circle, Vec2(1.0, 2.0), Vec2(-3.0, 4.5), 20.0, Vec2(0.0, 0.0));
  hash.add(7, Shape::Rectangle, Vec2(10.0, 20.0), Vec2(0.0, -0.0), 0.0, Vec2(30.0, 40.0));
  EXPECT_EQ(hash.value(), 0xfd028aedbebf6fd0ULL);
}

TEST(StateHash, TellsZeroFromMinusZeroButNotOneNanFromAnother) {
  EXPECT_NE(StateHash(0.0).value(), StateHash(-0.0).value());
  EXPECT_EQ(StateHash(std::numeric_limits<double>::quiet_NaN()).value(), StateHash(-std::nan("7")).value());
}

TEST(StateHash, OfAWorldCoversItsTimeAndLivingBodies) {
  WorldSetup setup;
  Body body;
  body.position = Vec2(100.0, 50.0);
  body.radius = 10.0;
  setup.bodies = {body};
  World world(setup);
  StateHash expected(0.0);
  expected.add(0, Shape::Circle, body.position, body.velocity, body.radius, body.size);
  EXPECT_EQ(world.stateHash(), expected.value());
  const std::uint64_t before = world.stateHash();
  world.step({1, 0.0, 0.0}); // nothing moves, no time passes
  EXPECT_EQ(world.stateHash(), before);
  world.step({2, 0.1, 0.1});
  EXPECT_NE(world.stateHash(), before);
}

} // namespace
} // namespace offstage
