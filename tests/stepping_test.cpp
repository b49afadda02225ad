#include "src/sim/clock.h"
#include "src/sim/world.h"
#include "tests/support/scene_text.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::int64_t kSecond = 1'000'000'000;

/// Frame times as a busy machine has them: 5 to 45 ms.
Clock jittery(unsigned seed, int frames) {
  std::mt19937 random(seed);
  std::vector<std::int64_t> durations;
  durations.reserve(static_cast<std::size_t>(frames));
  for (int i = 0; i < frames; ++i)
    durations.push_back(5'000'000 + static_cast<std::int64_t>(random() % 40'000'000));
  return Clock::recorded(durations);
}

/// A ball that falls and bounces, drag and a spawner: every part of a step has something to do.
WorldSetup setupOf(const std::string& clock) {
  return sceneOf("[clock]\nfps = 60\n" + clock +
                 "[walls]\nbottom = 0.8\n[[body]]\ncenter = [320, 300]\nradius = 20\nvelocity = [30, 0]\n"
                 "[[spawn]]\nevery = 0.3\nx = { int = 640 }\ny = { int = 480 }\nradius = 5\nvx = { spread = "
                 "50 }\n"
                 "[[collide]]\nbetween = ['bodies', 'bodies']\n[[force]]\ntype = 'drag'\nlinear = 0.1\n")
      .world;
}

void run(World& world, const Clock& clock) {
  while (world.frame() < clock.steps()) world.step(clock.tick(world.frame() + 1));
}

std::vector<double> stateOf(const World& world) {
  std::vector<double> state;
  for (const Body& body : world.bodies())
    state.insert(state.end(), {body.position.x(), body.position.y(), body.velocity.x(), body.velocity.y()});
  return state;
}

TEST(Stepping, VariableStepsAreAsLongAsTheirFrames) {
  const Clock clock = jittery(1, 100);
  World world(sceneOf("[world]\ngravity = [0, 10]\n[[body]]\ncenter = [0, 0]\nradius = 1\n").world);
  double v = 0.0;
  double y = 0.0;
  for (std::int64_t k = 1; k <= clock.steps(); ++k) {
    const double h = clock.tick(k).dt;
    v = v + 10.0 * h;
    y = y + v * h;
    world.step(clock.tick(k));
    ASSERT_EQ(world.bodies()[0].position.y(), y) << "frame " << k;
  }
}

TEST(Stepping, FixedStepsDoNotSeeTheFrames) {
  World jittered(setupOf("step = 'fixed'\n"));
  run(jittered, jittery(2, 200));
  World steady(setupOf(""));
  run(steady, Clock::fixed(60.0, 200));
  EXPECT_EQ(stateOf(jittered), stateOf(steady));
  EXPECT_DOUBLE_EQ(jittered.time(), 200.0 / 60.0); // whatever the frames' time
}

TEST(Stepping, AccumulatedStepsDependOnTheTimeThatHasPassedAlone) {
  for (unsigned seed = 3; seed < 8; ++seed) {
    const Clock clock = jittery(seed, 150);
    World jittered(setupOf("step = 'accumulator'\n"));
    run(jittered, clock);
    const auto steps = static_cast<std::int64_t>(std::floor(clock.duration() * 60.0));
    World steady(setupOf(""));
    run(steady, Clock::fixed(60.0, steps));
    EXPECT_EQ(stateOf(jittered), stateOf(steady)) << "seed " << seed;
    EXPECT_NEAR(jittered.time(), static_cast<double>(steps) / 60.0, 1e-12);
  }
}

TEST(Stepping, AccumulatedRestsAreNotRoundedAway) {
  // 600 frames of exactly a third of a step: 200 steps, not 199.
  const Clock clock = Clock::recorded(std::vector<std::int64_t>(600, kSecond / 300));
  World world(
      sceneOf("[clock]\nfps = 60\nstep = 'accumulator'\ndt = 0.01\n[[body]]\ncenter=[0, 0]\nradius=1\n")
          .world);
  std::vector<double> times;
  for (std::int64_t k = 1; k <= clock.steps(); ++k) {
    world.step(clock.tick(k));
    times.push_back(world.time());
  }
  EXPECT_EQ(times[0], 0.0);
  EXPECT_EQ(times[1], 0.0);
  EXPECT_NEAR(times.back(), 1.99, 0.0100001); // 600·3333333 ns are 1.9999998 s
  World exact(
      sceneOf("[clock]\nfps = 60\nstep = 'accumulator'\ndt = 0.01\n[[body]]\ncenter=[0, 0]\nradius=1\n")
          .world);
  run(exact, Clock::recorded(std::vector<std::int64_t>(600, 10'000'000)));
  EXPECT_DOUBLE_EQ(exact.time(), 6.0);
}

TEST(Stepping, ClampedStepsAreNeverLongerThanDtAndEndWithTheFrame) {
  // Semi-implicit Euler in steps h: v = Σ g·h, y = Σ v·h, taken apart here by hand for a frame of 2.5 dt.
  World world(sceneOf("[clock]\nstep = 'clamped'\ndt = 0.1\n[world]\ngravity = [0, 10]\n[[body]]\ncenter=[0, "
                      "0]\nradius=1\n")
                  .world);
  const Clock clock = Clock::recorded({250'000'000, 50'000'000});
  world.step(clock.tick(1));
  EXPECT_NEAR(world.bodies()[0].velocity.y(), 2.5, 1e-12);
  EXPECT_NEAR(world.bodies()[0].position.y(), 0.1 * 1.0 + 0.1 * 2.0 + 0.05 * 2.5, 1e-12);
  EXPECT_EQ(world.time(), 0.25);
  world.step(clock.tick(2)); // shorter than dt: one step
  EXPECT_NEAR(world.bodies()[0].position.y(), 0.425 + 0.05 * 3.0, 1e-12);
  EXPECT_EQ(world.time(), clock.time(2));
}

TEST(Stepping, PicturesShowAccumulatedBodiesBetweenTheLastTwoSteps) {
  World world(sceneOf("[clock]\nstep = 'accumulator'\ndt = 0.1\n[world]\ngravity = [0, 0]\n"
                      "[[body]]\ncenter=[0, 50]\nradius=1\nvelocity=[100, 0]\n")
                  .world);
  const Clock clock = Clock::recorded({225'000'000, 50'000'000});
  std::vector<Body> blended;
  world.step(clock.tick(1)); // two steps, a quarter of one left over
  EXPECT_EQ(world.bodies()[0].position.x(), 20.0);
  EXPECT_NEAR(world.shown(blended)[0].position.x(), 12.5, 1e-9);
  world.step(clock.tick(2)); // no step, three quarters left over
  EXPECT_EQ(world.bodies()[0].position.x(), 20.0);
  EXPECT_NEAR(world.shown(blended)[0].position.x(), 17.5, 1e-9);
  World variable(sceneOf("[[body]]\ncenter=[0, 50]\nradius=1\n").world);
  variable.step(clock.tick(1));
  EXPECT_EQ(variable.shown(blended).data(), variable.bodies().data());
}

TEST(Stepping, LaunchesOfAFrameWithoutAStepWaitForTheNextOneAndHappenOnce) {
  World world(sceneOf("[clock]\nstep = 'accumulator'\ndt = 0.1\n"
                      "[[launch]]\nframe = [1, 2]\nfrom=[0, 0]\ntoward=[1, 0]\nspeed=10\nradius=1\n")
                  .world);
  const Clock clock = Clock::recorded({40'000'000, 210'000'000, 200'000'000}); // no step, two, two
  std::vector<std::size_t> fired;
  for (std::int64_t k = 1; k <= 3; ++k) {
    world.step(clock.tick(k));
    fired.push_back(world.events().size());
  }
  EXPECT_THAT(fired, ElementsAre(0, 2, 0));
}

TEST(Stepping, KeysThatDoNotFitAreRefused) {
  EXPECT_THAT(errorsOf("[clock]\ndt = 0.1\n").at(0),
              HasSubstr("'dt' in [clock] belongs to the steps \"fixed\""));
  EXPECT_THAT(errorsOf("[clock]\nstep = 'fixd'\n").at(0), HasSubstr("did you mean \"fixed\"?"));
  EXPECT_THAT(errorsOf("[clock]\nstep = 'fixed'\ndt = 0\n").at(0),
              HasSubstr("must be from 1e-06 to 10, but it is"));
}

} // namespace
} // namespace offstage::test
