#include "src/sim/world.h"
#include "tests/support/sim_setup.h"

#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

constexpr double kFrame = 1.0 / 60.0;

WorldSetup stillSetup() {
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  setup.groups = {"shots", "targets"};
  return setup;
}

Body shot(double x, double y, const Vec2& velocity, double radius = 3.0) {
  Body body = circle(x, y, radius, velocity);
  body.continuous = true;
  return body;
}

Body target(Body body) {
  body.group = 1;
  return body;
}

TEST(SweptContacts, ProjectileOf6000PixelsASecondHitsATargetOf4) {
  for (const bool continuous : {false, true}) {
    for (const ContactModel model : {ContactModel::Lecture, ContactModel::Solver}) {
      for (const Body& body : {circle(350, 240, 2), rectangle(348, 238, 4, 4)}) {
        WorldSetup setup = stillSetup();
        setup.contactModel = model;
        setup.bodies = {shot(40, 240, Vec2(6000, 0)), target(body)};
        setup.bodies[0].continuous = continuous;
        setup.contacts = {{.groupA = 0, .groupB = 1, .response = Response::RemoveImmediately}};
        World world(setup);
        std::size_t hits = 0;
        for (int frame = 1; frame <= 5; ++frame) {
          world.step({frame, frame * kFrame, kFrame});
          for (const Event& event : world.events()) hits += event.kind == EventKind::Hit ? 1U : 0U;
        }
        EXPECT_EQ(hits, continuous ? 1U : 0U) << "a shot moves 100 px a frame";
        EXPECT_EQ(world.bodies().size(), continuous ? 0U : 2U);
      }
    }
  }
}

TEST(SweptContacts, BounceHappensWhereTheyTouchAndTheRestOfTheStepFollows) {
  // 96 px to go at 6000 px/s: 16 ms of a step of 1/60 s. The equal masses exchange their velocities.
  WorldSetup setup = stillSetup();
  setup.bodies = {shot(100, 240, Vec2(6000, 0)), target(circle(201, 240, 2))};
  setup.contacts = {{.groupA = 0, .groupB = 1}};
  World world(setup);
  world.step({1, kFrame, kFrame});
  ASSERT_EQ(world.events().size(), 1U);
  EXPECT_EQ(world.events()[0].kind, EventKind::Collide);
  EXPECT_EQ(world.events()[0].p, 5.0);
  EXPECT_EQ(world.events()[0].q, 6000.0);
  EXPECT_NEAR(world.bodies()[0].position.x(), 196.0, 6000.0 * 1e-9);
  EXPECT_EQ(world.bodies()[0].velocity, Vec2(0, 0));
  EXPECT_NEAR(world.bodies()[1].position.x(), 201.0 + 6000.0 * (kFrame - 0.016), 6000.0 * 1e-9);
  EXPECT_EQ(world.bodies()[1].velocity, Vec2(6000, 0));
}

TEST(SweptContacts, WallsAndFixedBodiesThrowBackTheRestOfTheWay) {
  // To the block's side in 1/120 s, back at half the speed, and to the left wall in the step after.
  WorldSetup setup = stillSetup();
  setup.walls.restitution.fill(0.5);
  Body block = target(rectangle(157, 200, 3, 80));
  block.fixed = true;
  setup.bodies = {shot(104, 240, Vec2(6000, 0)), block};
  setup.contacts = {{.groupA = 0, .groupB = 1, .restitution = 0.5}};
  World world(setup);
  world.step({1, kFrame, kFrame});
  EXPECT_NEAR(world.bodies()[0].position.x(), 154.0 - 3000.0 / 120.0, 1e-5);
  EXPECT_EQ(world.bodies()[0].velocity, Vec2(-3000, 0));
  world.step({2, 2 * kFrame, kFrame});
  world.step({3, 3 * kFrame, kFrame});
  world.step({4, 4 * kFrame, kFrame});
  // 126 px to the wall take 0.042 s; the rest of the three steps, 0.008 s, it goes right at 1500 px/s.
  EXPECT_NEAR(world.bodies()[0].position.x(), 3.0 + 1500.0 * 0.008, 1e-5);
  EXPECT_EQ(world.bodies()[0].velocity, Vec2(1500, 0));
}

TEST(SweptContacts, EveryWallIsHitAtItsOwnMoment) {
  // Into the lower right corner, 40 px before one wall and 80 before the other, 100 px a step along each
  // axis.
  WorldSetup setup = stillSetup();
  setup.walls.restitution.fill(1.0);
  setup.bodies = {shot(640 - 43, 480 - 83, Vec2(6000, 6000))};
  World world(setup);
  world.step({1, kFrame, kFrame});
  ASSERT_EQ(world.events().size(), 2U);
  EXPECT_EQ(world.events()[0].kind, EventKind::Right);
  EXPECT_EQ(world.events()[1].kind, EventKind::Bottom);
  EXPECT_NEAR(world.bodies()[0].position.x(), 637.0 - 60.0, 1e-9);
  EXPECT_NEAR(world.bodies()[0].position.y(), 477.0 - 20.0, 1e-9);
  EXPECT_EQ(world.bodies()[0].velocity, Vec2(-6000, -6000));
}

TEST(SweptContacts, NearestOfSeveralIsHitFirstWhateverTheOrderOfCreation) {
  WorldSetup setup = stillSetup();
  setup.bodies = {target(circle(180, 240, 4)), target(circle(120, 240, 4)), shot(80, 240, Vec2(7200, 0))};
  setup.contacts = {{.groupA = 0, .groupB = 1, .response = Response::RemoveImmediately}};
  World world(setup);
  world.step({1, kFrame, kFrame});
  ASSERT_EQ(world.events().size(), 1U);
  EXPECT_EQ(world.events()[0].first, 1);
  EXPECT_EQ(world.events()[0].second, 2);
  ASSERT_EQ(world.bodies().size(), 1U);
  EXPECT_EQ(world.bodies()[0].id, 0U);
}

TEST(SweptContacts, SimultaneousImpactsGoByTheNumbersOfTheBodies) {
  // Two shots reach the same target at the same moment: the one of lower number takes it.
  WorldSetup setup = stillSetup();
  setup.bodies = {shot(400, 240, Vec2(-6000, 0)), shot(240, 240, Vec2(6000, 0)), target(circle(320, 240, 4))};
  setup.contacts = {{.groupA = 0, .groupB = 1, .response = Response::RemoveImmediately}};
  World world(setup);
  world.step({1, kFrame, kFrame});
  ASSERT_EQ(world.events().size(), 1U);
  EXPECT_EQ(world.events()[0].first, 0);
  EXPECT_EQ(world.events()[0].second, 2);
  ASSERT_EQ(world.bodies().size(), 1U);
  EXPECT_EQ(world.bodies()[0].id, 1U);
  EXPECT_EQ(world.bodies()[0].position, Vec2(340, 240)) << "the other flies on";
}

TEST(SweptContacts, SensorReportsOnceAndLetsPass) {
  WorldSetup setup = stillSetup();
  setup.bodies = {shot(100, 240, Vec2(6000, 0)), target(rectangle(150, 200, 2, 80))};
  setup.contacts = {{.groupA = 0, .groupB = 1, .response = Response::Report}};
  World world(setup);
  world.step({1, kFrame, kFrame});
  ASSERT_EQ(world.events().size(), 1U);
  EXPECT_EQ(world.events()[0].kind, EventKind::Touch);
  EXPECT_EQ(world.bodies()[0].position, Vec2(200, 240));
  world.step({2, 2 * kFrame, kFrame});
  EXPECT_TRUE(world.events().empty());
}

TEST(SweptContacts, SlowContinuousBodyBouncesAsAnyOther) {
  WorldSetup setup = stillSetup();
  setup.gravity = Vec2(0, 900);
  setup.walls.restitution.fill(0.8);
  setup.bodies = {circle(200, 100, 10, Vec2(50, 0)), target(circle(400, 100, 10, Vec2(50, 0)))};
  setup.bodies[0].continuous = true;
  World world(setup);
  for (int frame = 1; frame <= 600; ++frame) {
    world.step({frame, frame * kFrame, kFrame});
    for (const Body& body : world.bodies()) {
      ASSERT_LE(body.position.y(), 470.0) << "body " << body.id << ", frame " << frame;
      ASSERT_LE(body.position.x(), 630.0) << "body " << body.id << ", frame " << frame;
    }
  }
  EXPECT_GT(world.bodies()[0].position.y(), 460.0) << "it has come to rest as the other has";
  EXPECT_GT(world.bodies()[1].position.y(), 460.0);
}

TEST(SweptContacts, EndlessBouncesBetweenTwoBlocksEnd) {
  // A gap hardly wider than the ball: thousands of impacts a step, of which 64 are made.
  WorldSetup setup = stillSetup();
  setup.bodies = {shot(100.0, 240, Vec2(60000, 0), 3.0), target(rectangle(50, 200, 46.99, 80)),
                  target(rectangle(103.01, 200, 50, 80))};
  setup.bodies[1].fixed = setup.bodies[2].fixed = true;
  setup.contacts = {{.groupA = 0, .groupB = 1}};
  World world(setup);
  world.step({1, kFrame, kFrame});
  EXPECT_GE(world.events().size(), 64U);
  EXPECT_LE(world.events().size(), 66U);
}

} // namespace
} // namespace offstage::test
