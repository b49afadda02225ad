#include "src/scene/scene.h"
#include "src/scene/warning_text.h"
#include "src/sim/watch.h"
#include "src/sim/world.h"
#include "tests/support/process.h"
#include "tests/support/scene_names.h"
#include "tests/support/scene_text.h"
#include "tests/support/sim_setup.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kFrame = 1.0 / 60.0;

WorldSetup floating() {
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  setup.groups = {"shots", "targets"};
  return setup;
}

/// Warnings of a run of so many frames.
std::vector<Warning> warningsOf(const WorldSetup& setup, int frames) {
  World world(setup);
  Watch watch(world);
  std::vector<Warning> warnings;
  for (int frame = 1; frame <= frames; ++frame)
    for (const Warning& warning : watch.step(world, {frame, frame * kFrame, kFrame}))
      warnings.push_back(warning);
  return warnings;
}

/// What a scene's run, or a panel's, is warned of, in words.
std::vector<std::string> warningsOf(const Scene& scene) {
  std::vector<std::string> texts;
  if (scene.replay) return texts;
  const WarningText text(scene);
  World world(scene.world);
  Watch watch(world);
  while (world.frame() < scene.clock.steps())
    for (const Warning& warning : watch.step(world, scene.clock.tick(world.frame() + 1)))
      if (!text.isExpected(warning)) texts.push_back(text.of(warning));
  return texts;
}

template <typename What>
const What& only(const std::vector<Warning>& warnings) {
  if (warnings.size() != 1 || !std::holds_alternative<What>(warnings[0].what))
    throw std::runtime_error("not the one warning that was expected, but " + std::to_string(warnings.size()));
  return std::get<What>(warnings[0].what);
}

TEST(Watch, HasNothingToSayOfTheScenesOfThisRepository) {
  for (const std::string& name : sceneNames()) {
    const Scene whole = loadScene(scene(name));
    EXPECT_THAT(warningsOf(whole), IsEmpty()) << name;
    for (const Panel& panel : whole.panels.panels)
      EXPECT_THAT(warningsOf(*panel.scene), IsEmpty()) << name << ", " << panel.title;
  }
}

TEST(Watch, ChangesNoBitOfTheRun) {
  const Scene pile = loadScene(scene("pile"));
  const Scene bounce = loadScene(scene("exercise2_bounce"));
  for (const Scene* each : {&pile, &bounce}) {
    World watched(each->world);
    World plain(each->world);
    Watch watch(watched);
    for (std::int64_t frame = 1; frame <= 200; ++frame) {
      watch.step(watched, each->clock.tick(frame));
      plain.step(each->clock.tick(frame));
    }
    EXPECT_EQ(watched.stateHash(), plain.stateHash()) << each->title;
  }
}

TEST(Watch, TellsTheFrameAndTheBodyThatIsNowhereOnce) {
  WorldSetup setup = floating();
  setup.bodies = {circle(10, 10, 5), circle(100, 10, 5, Vec2(60, 0))};
  addForce(setup, {CustomForce{[](const ForceState& state) { // 0/0 at x = 103
                     const double x = state.position.x() - 103.0;
                     return Vec2(x == 0.0 ? std::numeric_limits<double>::quiet_NaN() : 0.0, 0.0);
                   }},
                   {},
                   {}});
  const std::vector<Warning> warnings = warningsOf(setup, 20);
  only<NotFinite>(warnings);
  EXPECT_EQ(warnings[0].frame, 4);
  EXPECT_EQ(warnings[0].time, 4 * kFrame);
  EXPECT_EQ(warnings[0].body, 1U);
}

TEST(Watch, AShotThatGoesThroughItsTarget) {
  const auto run = [](bool continuous, double y, Response response) {
    WorldSetup setup = floating();
    setup.bodies = {circle(350, 240, 2), circle(40, y, 3, Vec2(6000, 0))};
    setup.bodies[0].group = 1;
    setup.bodies[1].continuous = continuous;
    setup.contacts = {{.groupA = 0, .groupB = 1, .response = response}};
    return warningsOf(setup, 10);
  };
  for (const Response response : {Response::Bounce, Response::RemoveImmediately, Response::Report}) {
    const std::vector<Warning> warnings = run(false, 240, response);
    const auto& crossing = only<Crossing>(warnings);
    EXPECT_EQ(warnings[0].frame, 4) << "from 340 to 440";
    EXPECT_EQ(warnings[0].body, 1U);
    EXPECT_EQ(crossing.other, 0U);
    EXPECT_NEAR(crossing.way, 100.0, 1e-9);
    EXPECT_EQ(crossing.width, 10.0);
    EXPECT_THAT(run(true, 240, response), IsEmpty());
    EXPECT_THAT(run(false, 244.5, response), IsEmpty()) << "a graze";
    EXPECT_THAT(run(false, 246, response), IsEmpty()) << "a miss";
  }
}

TEST(Watch, OnlyPairsWithARuleThatDidNotTouchHaveCrossed) {
  WorldSetup setup = floating();
  setup.bodies = {rectangle(300, 200, 4, 80), circle(40, 240, 3, Vec2(6000, 0))};
  setup.bodies[0].group = 1;
  setup.bodies[0].fixed = true;
  EXPECT_THAT(warningsOf(setup, 10), IsEmpty()) << "no rule: it is to pass";
  setup.contacts = {{.groupA = 0, .groupB = 1}};
  EXPECT_EQ(warningsOf(setup, 10).size(), 1U);
  setup.substeps = 15; // 6.7 px a step
  EXPECT_THAT(warningsOf(setup, 10), IsEmpty());
}

TEST(Watch, TwoThatFlyThroughEachOtherAndTwoThatFlySideBySide) {
  WorldSetup setup = floating();
  setup.contacts = {{.groupA = 0, .groupB = 0}};
  setup.bodies = {circle(300, 240, 5, Vec2(1500, 0)), circle(335, 240, 5, Vec2(-1500, 0))};
  EXPECT_EQ(only<Crossing>(warningsOf(setup, 3)).way, 50.0);
  setup.bodies[1] = circle(312, 240, 5, Vec2(1500, 0));
  EXPECT_THAT(warningsOf(setup, 3), IsEmpty());
}

TEST(Watch, ABodyThatStaysBehindAnEdge) {
  // As the exercise words it, whoever touches flips: this one is too fast to come back in one frame.
  WorldSetup setup;
  setup.gravity = Vec2(0.0, 5000.0);
  setup.walls.clamp = false;
  setup.walls.restitution[static_cast<std::size_t>(Side::Bottom)] = 0.5;
  setup.bodies = {circle(100, 100, 5), circle(100, 900, 5)};
  setup.bodies[1].feelsGravity = false; // is out there from the beginning
  const std::vector<Warning> warnings = warningsOf(setup, 100);
  const auto& crossing = only<Crossing>(warnings);
  EXPECT_EQ(crossing.side, Side::Bottom);
  EXPECT_EQ(warnings[0].body, 0U);
  setup.walls.clamp = true;
  EXPECT_THAT(warningsOf(setup, 100), IsEmpty());
}

TEST(Watch, AMultiplierAboveOneAtTheWallsMakesEnergyFromNowhere) {
  WorldSetup setup = floating();
  setup.bodies = {circle(320, 240, 5, Vec2(1200, 0))};
  setup.walls.restitution.fill(1.0);
  EXPECT_THAT(warningsOf(setup, 600), IsEmpty());
  setup.walls.restitution.fill(1.3);
  const auto warnings = warningsOf(setup, 600);
  const auto& growth = only<EnergyGrowth>(warnings);
  // 1.3² a hit: more than 1 + 3 times the energy at the start after the sixth.
  EXPECT_TRUE(growth.walls);
  EXPECT_NEAR(growth.gained, (std::pow(1.69, 3) - 1.0) * 0.5 * 1200.0 * 1200.0, 1e-3);
}

TEST(Watch, AnUnstableSpringIsFoundByItsStepAndByItsEnergy) {
  WorldSetup setup = floating();
  setup.bodies = {circle(330, 240, 5)};
  addForce(setup, {SpringForce{{Vec2(320, 240), {}}, 160.0 * 160.0, 0.0, 0.0}, {}, {}});
  const std::vector<Warning> warnings = warningsOf(setup, 10);
  ASSERT_EQ(warnings.size(), 2U);
  const auto& step = std::get<LongStep>(warnings[0].what);
  EXPECT_EQ(warnings[0].frame, 1);
  EXPECT_EQ(step.step, kFrame);
  EXPECT_NEAR(step.limit, 2.0 / 160.0, 1e-9);
  EXPECT_EQ(step.frequency, 160.0);
  EXPECT_TRUE(std::holds_alternative<EnergyGrowth>(warnings[1].what));
  EXPECT_LE(warnings[1].frame, 3);
  setup.substeps = 2;
  EXPECT_THAT(warningsOf(setup, 600), IsEmpty());
}

TEST(Watch, AFallIntoAPointThatAttractsIsJudgedAlikeWhetherItIsAPointOrAFixedBody) {
  const auto run = [](const Anchor& center) {
    WorldSetup setup = floating();
    setup.bodies = {circle(320, 240, 5), circle(347, 240, 5)};
    setup.bodies[0].fixed = true;
    addForce(setup, {AttractForce{center, 1e7, 0.1}, {}, {}});
    return warningsOf(setup, 120);
  };
  const std::vector<Warning> point = run({Vec2(320, 240), {}});
  const std::vector<Warning> body = run({{}, 0U});
  only<EnergyGrowth>(point);
  only<EnergyGrowth>(body);
  EXPECT_EQ(point[0].frame, body[0].frame);
  EXPECT_EQ(body[0].body, 1U);
}

TEST(Watch, EnergyThatForcesSpawnsAndLaunchesBringIsNotFromNowhere) {
  const Scene scene = sceneOf(R"(
duration = 8.0
[world]
gravity = [0, 400]
[walls]
all = 0.9
[[body]]
name = "sun"
group = "suns"
center = [320, 240]
radius = 8
fixed = true
[[spawn]]
x = { int = 640 }
y = { int = 480 }
radius = { uniform = [4, 12] }
vx = { spread = 300 }
every = 0.2
group = "balls"
[[launch]]
at = [1, 1.5, 2]
from = [40, 440]
toward = [600, 100]
speed = 900
radius = 6
[[force]]
type = "attract"
to = "sun"
strength = 1e6
softening = 30
[[force]]
type = "spring"
to = [320, 100]
stiffness = 5
group = "balls"
[[collide]]
between = ["balls", "*"]
)");
  EXPECT_THAT(warningsOf(scene), IsEmpty());
}

TEST(Watch, ASlingshotPastAPointThatAttractsGainsEnergy) {
  // Nearly straight through the centre: the steps are far too long there.
  WorldSetup setup = floating();
  setup.bodies = {circle(520, 240, 4, Vec2(0, 3))};
  addForce(setup, {AttractForce{{Vec2(320, 240), {}}, 4e6, 0.0}, {}, {}});
  const auto warnings = warningsOf(setup, 600);
  EXPECT_TRUE(only<EnergyGrowth>(warnings).attract);
  setup.forces.clear();
  addForce(setup, {AttractForce{{Vec2(320, 240), {}}, 4e6, 60.0}, {}, {}});
  EXPECT_THAT(warningsOf(setup, 600), IsEmpty()) << "softened";
}

/// A run of 10 s of a body under an expression and, if any, what else stands in the scene.
std::vector<std::string> drivenBy(const std::string& fx, const std::string& fy,
                                  const std::string& more = {}) {
  return warningsOf(
      sceneOf("duration = 10.0\n[world]\ngravity = [0, 0]\n[[body]]\nname = \"b\"\ncenter = "
              "[330, 240]\nradius = 5\nvelocity = [30, 20]\n[[force]]\ntype = \"expression\"\nfx = \"" +
              fx + "\"\nfy = \"" + fy + "\"\n" + more));
}

TEST(Watch, TheWorkOfExpressionsAndWindIsNotFromNowhere) {
  EXPECT_THAT(drivenBy("500", "0"), IsEmpty()) << "a constant pull";
  EXPECT_THAT(drivenBy("-25*(x-320)+200*sin(5*t)", "-25*(y-240)"), IsEmpty()) << "resonance";
  EXPECT_THAT(drivenBy("2*vx", "2*vy"), IsEmpty()) << "negative drag: e^40 times the energy";
  EXPECT_THAT(drivenBy("3*vy", "-3*vx"), IsEmpty()) << "a magnetic field";
  EXPECT_THAT(drivenBy("0", "0", "[[force]]\ntype = \"wind\"\nvelocity = [900, 0]\ncoefficient = 2\n"),
              IsEmpty());
  EXPECT_THAT(drivenBy("0", "0",
                       "[[body]]\ncenter = [200, 100]\nradius = 3\nvelocity = [0, 40]\n[[force]]\ntype = "
                       "\"attract\"\nto = \"b\"\nstrength = 5e5\nsoftening = 20\n"),
              IsEmpty());
}

TEST(Watch, AForceThatSetsInAtOnceMayPushABodyFromRest) {
  for (const char* integrator : {"explicit-euler", "semi-implicit-euler", "verlet", "midpoint", "rk4"}) {
    EXPECT_THAT(warningsOf(sceneOf("duration = 3.0\n[world]\ngravity = [0, 0]\nintegrator = \"" +
                                   std::string(integrator) +
                                   "\"\n[[body]]\ncenter = [330, 240]\nradius = 5\n[[force]]\ntype = "
                                   "\"expression\"\nfx = \"t > 1 ? 9000 : 0\"\n")),
                IsEmpty())
        << integrator;
  }
}

TEST(Watch, AStiffExpressionGainsEnergyAsASpringDoes) {
  EXPECT_THAT(drivenBy("-40000*(x-320)", "-40000*(y-240)"),
              ElementsAre(HasSubstr("[energy]"), HasSubstr("[lost]")))
      << "and at last beyond all numbers";
  EXPECT_THAT(drivenBy("-4000*(x-320)", "-4000*(y-240)"), IsEmpty());
}

TEST(Watch, TheSlidesFormulaMakesEnergyThatItIsShownFor) {
  WorldSetup setup = floating();
  setup.walls.restitution.fill(1.0);
  setup.contacts = {{.groupA = 0, .groupB = 0, .response = Response::Slide}};
  setup.bodies = {circle(200, 240, 20, Vec2(60, 0)), circle(300, 240, 20), circle(400, 250, 20)};
  World world(setup);
  const auto kinetic = [&world] {
    double sum = 0.0;
    for (const Body& body : world.bodies()) sum += 0.5 * dot(body.velocity, body.velocity);
    return sum;
  };
  const double before = kinetic();
  Watch watch(world);
  std::size_t warned = 0;
  for (int frame = 1; frame <= 120; ++frame)
    for (const Warning& warning : watch.step(world, {frame, frame * kFrame, kFrame}))
      warned += std::holds_alternative<EnergyGrowth>(warning.what) ? 1U : 0U;
  EXPECT_GT(kinetic(), 10.0 * before);
  EXPECT_EQ(warned, 0U);
}

TEST(Watch, WordsNameFrameTimeBodyAndWhatToChange) {
  const Scene scene = sceneOf(R"(
duration = 0.2
[[body]]
name = "bob"
center = [330, 240]
radius = 5
[[force]]
type = "spring"
to = [320, 240]
stiffness = 40000
)");
  const std::vector<std::string> texts = warningsOf(scene);
  ASSERT_EQ(texts.size(), 2U);
  EXPECT_EQ(texts[0],
            "frame 1 (0.0166667 s), body 0 \"bob\": steps of 0.01667 s are too long for its spring: at "
            "200 rad/s \"semi-implicit-euler\" is stable up to 0.01 s; [clock] substeps = 2 is enough, or "
            "make the spring softer or the body heavier [step]");
  EXPECT_THAT(texts[1], HasSubstr("body 0 \"bob\": the bodies have gained "));
  EXPECT_THAT(texts[1], HasSubstr("[energy]"));
}

TEST(Watch, AScenesExpectationSilencesItsKindAlone) {
  const auto texts = [](const std::string& words) {
    return warningsOf(sceneOf("duration = 0.2\n[world]\nexpect = " + words +
                              "\n[[body]]\ncenter = [330, 240]\nradius = 5\n[[force]]\ntype = \"spring\"\n"
                              "to = [320, 240]\nstiffness = 40000\n"));
  };
  EXPECT_THAT(texts("[]"), ElementsAre(HasSubstr("[step]"), HasSubstr("[energy]")));
  EXPECT_THAT(texts("[\"step\"]"), ElementsAre(HasSubstr("[energy]")));
  EXPECT_THAT(texts("[\"energy\", \"step\"]"), IsEmpty());
}

} // namespace
} // namespace offstage::test
