#include "src/sim/world.h"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace offstage {
namespace {

Launch shot(const Launch::Moment& moment) {
  Launch launch;
  launch.moments = {moment};
  launch.from.point = Vec2(40, 440);
  launch.toward.point = Vec2(340, 40); // 3 : 4
  launch.speed = 100.0;
  launch.prototype.radius = 5.0;
  launch.prototype.feelsGravity = false;
  return launch;
}

/// The frames of the events of a kind in a run of `clock`.
std::vector<std::int64_t> framesOf(EventKind kind, const WorldSetup& setup, const Clock& clock) {
  std::vector<std::int64_t> frames;
  World world(setup);
  for (std::int64_t frame = 1; frame <= clock.steps(); ++frame) {
    world.step(clock.tick(frame));
    for (const Event& event : world.events()) {
      if (event.kind == kind) frames.push_back(event.frame);
    }
  }
  return frames;
}

TEST(Launch, FliesAtItsSpeedTowardsItsDestinationAndMovesInItsFirstStep) {
  WorldSetup setup;
  setup.launches = {shot({std::nullopt, 0.5})};
  World world(setup);
  world.step({1, 0.5, 0.5});
  ASSERT_EQ(world.bodies().size(), 1U);
  EXPECT_EQ(world.bodies()[0].velocity, Vec2((300.0 / 500.0) * 100.0, (-400.0 / 500.0) * 100.0));
  EXPECT_EQ(world.bodies()[0].position, Vec2(40, 440) + world.bodies()[0].velocity * 0.5);
  ASSERT_EQ(world.events().size(), 1U);
  EXPECT_EQ(world.events()[0].kind, EventKind::Fire);
  EXPECT_EQ(world.events()[0].first, 0);
  EXPECT_EQ(world.events()[0].p, world.bodies()[0].velocity.x());
  for (std::int64_t frame = 2; frame <= 20; ++frame)
    world.step({frame, 0.5 * static_cast<double>(frame), 0.5});
  EXPECT_LT(world.bodies()[0].position.y(), 40.0) << "it flies on past its destination";
}

TEST(Launch, IsDueInTheFirstFrameWhoseTimeIsNotBeforeIt) {
  const Clock clock = Clock::fixed(60.0, 120);
  using Frames = std::vector<std::int64_t>;
  const std::vector<std::pair<Launch::Moment, Frames>> cases{
      {{std::nullopt, 0.0}, {1}},    {{std::nullopt, -3.0}, {1}},   {{std::nullopt, 0.5}, {30}},
      {{std::nullopt, 0.501}, {31}}, {{std::nullopt, 1e9}, {}},     {{30, 0.0}, {30}},
      {{120, 0.0}, {120}},           {{std::int64_t{121}, 0.0}, {}}};
  for (const auto& [moment, frames] : cases) {
    WorldSetup setup;
    setup.launches = {shot(moment)};
    EXPECT_EQ(framesOf(EventKind::Fire, setup, clock), frames) << "time " << moment.time;
  }
  WorldSetup repeated;
  repeated.launches = {shot({5, 0.0})};
  repeated.launches[0].moments.push_back({std::nullopt, 1.0});
  repeated.launches[0].moments.push_back({5, 0.0});
  EXPECT_EQ(framesOf(EventKind::Fire, repeated, clock), (Frames{5, 5, 60}));
  // Two frames at one time: the first of them.
  WorldSetup still;
  still.launches = {shot({std::nullopt, 0.1})};
  EXPECT_EQ(framesOf(EventKind::Fire, still, Clock::recorded({100000000, 0, 0})), (Frames{1}));
}

TEST(Launch, WithoutADirectionFiresNothing) {
  WorldSetup setup;
  setup.bodies.resize(3);
  setup.launches = {shot({1, 0.0})};
  setup.launches[0].toward.point = setup.launches[0].from.point;
  World world(setup);
  world.step({1, 0.1, 0.1});
  EXPECT_EQ(world.bodies().size(), 3U);
  ASSERT_EQ(world.events().size(), 1U);
  EXPECT_EQ(world.events()[0].kind, EventKind::NoFire);
  EXPECT_EQ(world.events()[0].first, 3) << "the id that it would have had";
  EXPECT_EQ(world.events()[0].p, 40.0);
  EXPECT_EQ(world.events()[0].q, 440.0);
}

TEST(Launch, AimsFromAndAtBodiesWhereTheyAreAtLaunch) {
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  Body gun;
  gun.position = Vec2(100, 100);
  gun.velocity = Vec2(10, 0);
  Body box;
  box.shape = Shape::Rectangle;
  box.position = Vec2(300, 80);
  box.size = Vec2(20, 60); // centre (310, 110)
  setup.bodies = {gun, box};
  setup.launches = {shot({2, 0.0})};
  setup.launches[0].from.body = 0U;
  setup.launches[0].toward.body = 1U;
  setup.launches[0].prototype.integrator = Integrator::Exact;
  World world(setup);
  world.step({1, 1.0, 1.0}); // the gun is at (110, 100) now
  world.step({2, 2.0, 1.0});
  const Vec2 direction = Vec2(200, 10) / length(Vec2(200, 10));
  EXPECT_LT(length(world.bodies()[2].velocity - direction * 100.0), 1e-12);
  EXPECT_LT(length(world.bodies()[2].position - (Vec2(110, 100) + direction * 100.0)), 1e-12);
}

TEST(Launch, FromOrAtABodyThatIsGoneFiresNothing) {
  for (const bool from : {true, false}) {
    WorldSetup setup;
    Body runaway;
    runaway.velocity = Vec2(1e6, 0);
    runaway.removedOutside = true;
    setup.bodies = {runaway};
    setup.launches = {shot({2, 0.0})};
    (from ? setup.launches[0].from : setup.launches[0].toward).body = 0U;
    World world(setup);
    world.step({1, 0.1, 0.1});
    ASSERT_EQ(world.find(0), nullptr);
    world.step({2, 0.2, 0.1});
    ASSERT_EQ(world.events().size(), 1U);
    EXPECT_EQ(world.events()[0].kind, EventKind::NoFire);
    EXPECT_TRUE(world.bodies().empty());
  }
}

TEST(Launch, ToNowhereFiresNothing) {
  const double huge = std::numeric_limits<double>::max();
  for (const Vec2& target : {Vec2(huge, huge), Vec2(std::numeric_limits<double>::quiet_NaN(), 0.0)}) {
    WorldSetup setup;
    setup.launches = {shot({1, 0.0})};
    setup.launches[0].toward.point = target;
    World world(setup);
    world.step({1, 0.1, 0.1});
    EXPECT_TRUE(world.bodies().empty());
  }
}

} // namespace
} // namespace offstage
