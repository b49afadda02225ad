#include "src/scene/scene.h"
#include "src/sim/world.h"
#include "tests/support/scene_text.h"

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

using test::errorsOf;
using test::sceneOf;

const std::string kBall = "[[body]]\ncenter = [1, 2]\nradius = 3\n";

double constantOf(const Number& number) {
  const auto* constant = std::get_if<ConstantNumber>(&number);
  return constant != nullptr ? constant->value : std::nan("");
}

TEST(Scene, AnEmptyFileHasEveryDefault) {
  const Scene scene = parseScene("", "dir/nothing.toml");
  EXPECT_EQ(scene.title, "nothing");
  EXPECT_EQ(scene.size, (std::array<int, 2>{640, 480}));
  EXPECT_EQ(scene.background, Color::rgb(255, 255, 255));
  EXPECT_EQ(scene.scale, 1.0);
  EXPECT_TRUE(scene.clock.isFixed());
  EXPECT_EQ(scene.clock.fps(), 60.0);
  EXPECT_EQ(scene.clock.steps(), 600);
  const WorldSetup defaults;
  EXPECT_EQ(scene.world.pane, defaults.pane);
  EXPECT_EQ(scene.world.gravity, defaults.gravity);
  EXPECT_EQ(scene.world.seed, 0);
  EXPECT_EQ(scene.world.substeps, 1);
  EXPECT_EQ(scene.world.groups, defaults.groups);
  for (const auto& side : scene.world.walls.restitution) EXPECT_FALSE(side.has_value());
  EXPECT_TRUE(scene.looks.empty());
}

TEST(Scene, TheDesignsExampleWordForWord) {
  const Scene scene = sceneOf(test::designScene());
  EXPECT_EQ(scene.title, "Exercise 2, step 2");
  EXPECT_EQ(scene.clock.steps(), 1200);
  EXPECT_EQ(scene.world.seed, 2022);
  EXPECT_EQ(scene.world.gravity, Vec2(0.0, 9.8));
  EXPECT_EQ(scene.world.groups, (std::vector<std::string>{"balls", "bodies", "shots"}));
  EXPECT_EQ(scene.world.walls.restitution[static_cast<std::size_t>(Side::Bottom)], 0.8);
  EXPECT_FALSE(scene.world.walls.restitution[static_cast<std::size_t>(Side::Top)].has_value());
  EXPECT_TRUE(scene.world.walls.clamp);

  ASSERT_EQ(scene.world.bodies.size(), 1U);
  const Body& ball = scene.world.bodies[0];
  EXPECT_EQ(scene.bodyNames, (std::vector<std::string>{"ball"}));
  EXPECT_EQ(ball.position, Vec2(320.0, 440.0));
  EXPECT_EQ(ball.radius, 20.0);
  EXPECT_EQ(ball.integrator, Integrator::Rk4);
  EXPECT_EQ(ball.group, 0U);
  EXPECT_FALSE(ball.removedOutside);
  const Look& look = scene.looks.at(ball.look);
  EXPECT_EQ(std::get<Color>(look.fill.value()), Color::rgb(0, 0, 0));
  ASSERT_TRUE(look.stroke.has_value());
  EXPECT_EQ(look.stroke->width, 1.0);
  EXPECT_EQ(look.stroke->align, StrokeAlign::Centered);

  ASSERT_EQ(scene.world.spawners.size(), 1U);
  const Spawner& spawner = scene.world.spawners[0];
  EXPECT_EQ(spawner.every, 1.0);
  EXPECT_EQ(spawner.count, Spawner::Count::Spawned);
  EXPECT_EQ(spawner.when, Spawner::When::BeforeUpdate);
  EXPECT_EQ(spawner.limit, 100);
  EXPECT_EQ(std::get<IntegerNumber>(spawner.x).bound, 640);
  EXPECT_EQ(std::get<IntegerNumber>(spawner.y).bound, 480);
  EXPECT_EQ(std::get<IntegerNumber>(spawner.radius).bound, 50);
  EXPECT_EQ(std::get<SpreadNumber>(spawner.vx).half, 120.0);
  EXPECT_EQ(std::get<SpreadNumber>(spawner.vy).half, 120.0);
  EXPECT_EQ(constantOf(spawner.ax), 0.0);
  EXPECT_EQ(constantOf(spawner.mass), 1.0);
  EXPECT_EQ(spawner.prototype.integrator, Integrator::SemiImplicitEuler);
  EXPECT_EQ(spawner.looks.size(), 1U);

  ASSERT_EQ(scene.world.launches.size(), 1U);
  const Launch& launch = scene.world.launches[0];
  ASSERT_EQ(launch.moments.size(), 2U);
  EXPECT_EQ(launch.moments[1].time, 1.0);
  EXPECT_FALSE(launch.moments[1].frame.has_value());
  EXPECT_EQ(launch.from.point, Vec2(40.0, 440.0));
  EXPECT_EQ(launch.toward.point, Vec2(320.0, 120.0));
  EXPECT_EQ(launch.speed, 200.0);
  EXPECT_EQ(launch.prototype.radius, 5.0);
  EXPECT_EQ(launch.prototype.group, 2U);
  EXPECT_FALSE(launch.prototype.feelsGravity);
  EXPECT_TRUE(launch.prototype.removedOutside);

  ASSERT_EQ(scene.world.contacts.size(), 1U);
  EXPECT_EQ(scene.world.contacts[0].response, Response::Bounce);
  EXPECT_EQ(scene.world.contacts[0].groupA, 0U);
  EXPECT_TRUE(scene.world.contacts[0].separate);
  ASSERT_EQ(scene.world.forces.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<DragForce>(scene.world.forces[0].kind));

  World world(scene.world); // and it runs
  for (std::int64_t frame = 1; frame <= 120; ++frame) world.step(scene.clock.tick(frame));
  EXPECT_EQ(world.bodies().size(), 5U) << "the ball, two spawned and two launched circles";
}

TEST(Scene, ABounceSeparatesUnaskedAndASlideOnlyWhenAsked) {
  const auto separates = [](const std::string& keys) {
    return sceneOf(
               "[[body]]\ncenter = [1, 2]\nradius = 3\n[[collide]]\nbetween = [\"bodies\", \"bodies\"]\n" +
               keys)
        .world.contacts.at(0)
        .separate;
  };
  EXPECT_TRUE(separates(""));
  EXPECT_FALSE(separates("separate = false\n"));
  EXPECT_FALSE(separates("response = \"slide\"\n"));
  EXPECT_TRUE(separates("response = \"slide\"\nseparate = true\n"));
}

/// The responses of a scene with a body each of the groups "a", "b" and "c", as "ab bounce": its [[collide]]
/// tables are `rules`.
std::vector<std::string> responsesOf(const std::string& rules) {
  std::string text;
  for (const char* group : {"a", "b", "c"})
    text += fmt::format("[[body]]\ngroup = \"{}\"\ncenter = [1, 2]\nradius = 3\n", group);
  const Scene scene = sceneOf(text + rules);
  std::vector<std::string> responses;
  for (const ContactRule& rule : scene.world.contacts)
    responses.push_back(scene.world.groups[rule.groupA] + scene.world.groups[rule.groupB] +
                        (rule.response == Response::Bounce   ? " bounce"
                         : rule.response == Response::Report ? " report"
                                                             : " remove"));
  return responses;
}

TEST(Scene, AStarInACollisionStandsForEveryGroup) {
  using ::testing::ElementsAre;
  const std::string all = "[[collide]]\nbetween = [\"*\", \"*\"]\n";
  const std::string ofA = "[[collide]]\nbetween = [\"*\", \"a\"]\nresponse = \"report\"\n";
  const std::string ab = "[[collide]]\nbetween = [\"b\", \"a\"]\nresponse = \"remove\"\n";
  EXPECT_THAT(responsesOf(all),
              ElementsAre("aa bounce", "ab bounce", "ac bounce", "bb bounce", "bc bounce", "cc bounce"));
  EXPECT_THAT(responsesOf(ofA), ElementsAre("aa report", "ab report", "ac report"));
  EXPECT_THAT(responsesOf(all + ofA + ab),
              ElementsAre("aa report", "ab remove", "ac report", "bb bounce", "bc bounce", "cc bounce"))
      << "what names more groups counts";
  EXPECT_THAT(responsesOf(ab + all + "except = [\"b\"]\n"),
              ElementsAre("aa bounce", "ab remove", "ac bounce", "cc bounce"));
  EXPECT_THAT(responsesOf(ofA + "except = [\"a\", \"c\"]\n"), ElementsAre("ab report"));
  EXPECT_THAT(responsesOf(ofA + ab + "[[collide]]\nbetween = [\"b\", \"*\"]\n"),
              ElementsAre("aa report", "ab remove", "ac report", "bb bounce", "bc bounce"));
}

TEST(Scene, AStarStandsForAtMost256Groups) {
  std::string text;
  for (int i = 0; i < 257; ++i)
    text += fmt::format("[[body]]\ngroup = \"g{}\"\ncenter = [1, 2]\nradius = 3\n", i);
  EXPECT_THAT(errorsOf(text + "[[collide]]\nbetween = [\"g1\", \"*\"]\n"),
              ::testing::ElementsAre(
                  "scene.toml:1029:1: error: \"*\" stands for 257 groups; it may for at most 256"));
}

TEST(Scene, StepsAreDurationTimesFpsRoundedUp) {
  const auto steps = [](double duration, double fps) {
    return sceneOf(fmt::format("duration = {}\n[clock]\nfps = {}\n", duration, fps)).clock.steps();
  };
  EXPECT_EQ(steps(20, 60), 1200);
  EXPECT_EQ(steps(0.1, 30), 3);
  EXPECT_EQ(steps(0.7, 10), 7);
  EXPECT_EQ(steps(1.01, 10), 11);
  EXPECT_EQ(steps(0, 60), 0);
  EXPECT_EQ(steps(86400, 1e6), 86400000000);
  EXPECT_EQ(steps(10, 1e-9), 0);
}

TEST(Scene, RectanglesImagesAndStrokes) {
  const std::string folder = OFFSTAGE_SOURCE_DIR "/tests/reference/stills/";
  const Scene scene = parseScene(
      "[[body]]\nshape = \"rectangle\"\nposition = [1, 2]\nsize = [3, 4]\n"
      "fill = { image = \"assets/quad.png\", anchor = [5, 6, 7, 8], proportional = false }\n"
      "stroke = { image = \"assets/coord.png\", width = 2.5, align = \"inside\" }\nopacity = 0.25\n",
      folder + "a.toml");
  const Body& box = scene.world.bodies[0];
  EXPECT_EQ(box.shape, Shape::Rectangle);
  EXPECT_EQ(box.position, Vec2(1.0, 2.0));
  EXPECT_EQ(box.size, Vec2(3.0, 4.0));
  EXPECT_EQ(box.radius, 0.0);
  const Look& look = scene.looks.at(box.look);
  const auto& fill = std::get<ImagePattern>(look.fill.value());
  EXPECT_EQ(fill.file, folder + "assets/quad.png");
  EXPECT_EQ(fill.anchor, (std::array<double, 4>{5, 6, 7, 8}));
  EXPECT_FALSE(fill.proportional);
  EXPECT_EQ(fill.where.file, folder + "a.toml");
  EXPECT_EQ(fill.where.line, 5U);
  EXPECT_EQ(fill.where.column, 18U);
  const auto& stroke = std::get<ImagePattern>(look.stroke->paint);
  EXPECT_EQ(stroke.anchor, (std::array<double, 4>{0, 0, 1, 1}));
  EXPECT_TRUE(stroke.proportional);
  EXPECT_EQ(look.stroke->width, 2.5);
  EXPECT_EQ(look.stroke->align, StrokeAlign::Inside);
  EXPECT_EQ(look.opacity, 0.25);
}

TEST(Scene, EqualLooksAreShared) {
  const Scene scene = sceneOf(kBall + kBall + kBall + "fill = \"none\"\n" + kBall + "fill = \"#000\"\n" +
                              kBall + "opacity = 0.5\n");
  ASSERT_EQ(scene.looks.size(), 3U);
  EXPECT_EQ(scene.world.bodies[1].look, 0U);
  EXPECT_FALSE(scene.looks[scene.world.bodies[2].look].fill.has_value());
  EXPECT_EQ(scene.world.bodies[3].look, 0U);
  EXPECT_EQ(scene.world.bodies[4].look, 2U);
}

TEST(Scene, IntegratorsOfTheWorldAndOfBodies) {
  const Scene scene =
      sceneOf("[world]\nintegrator = \"verlet\"\n" + kBall + kBall + "integrator = \"midpoint\"\n" +
              "[[spawn]]\nx = 1\ny = 2\nradius = 3\n"
              "[[launch]]\nframe = 3\nfrom = [0, 0]\ntoward = [1, 1]\nspeed = 1\nradius = 1\n");
  EXPECT_EQ(scene.world.bodies[0].integrator, Integrator::Verlet);
  EXPECT_EQ(scene.world.bodies[1].integrator, Integrator::Midpoint);
  EXPECT_EQ(scene.world.spawners[0].prototype.integrator, Integrator::Verlet);
  EXPECT_EQ(scene.world.launches[0].prototype.integrator, Integrator::Verlet);
  EXPECT_EQ(scene.world.launches[0].moments.at(0).frame, 3);
}

TEST(Scene, WallsAllAndOneOfItsOwn) {
  const Walls walls = sceneOf("[walls]\nall = 0.9\ntop = 0\nclamp = false\n").world.walls;
  EXPECT_EQ(walls.restitution, (decltype(walls.restitution){0.9, 0.9, 0.0, 0.9}));
  EXPECT_FALSE(walls.clamp);
}

TEST(Scene, SpawnsTakeConstantsPairsAndEveryGenerator) {
  const Scene scene =
      sceneOf("[[spawn]]\nshape = \"rectangle\"\nposition = [1, 2]\nwidth = { uniform = [3, 4] }\n"
              "height = { gaussian = [5, 6] }\nvelocity = [7, 8]\nax = 9\nmass = { int = 3 }\n"
              "fill = { cycle = [\"red\", \"blue\", \"red\"] }\ncount = \"alive\"\n"
              "when = \"after-update\"\nleaving = \"remove\"\n");
  const Spawner& spawner = scene.world.spawners[0];
  EXPECT_EQ(constantOf(spawner.x), 1.0);
  EXPECT_EQ(constantOf(spawner.y), 2.0);
  EXPECT_EQ(std::get<UniformNumber>(spawner.width).high, 4.0);
  EXPECT_EQ(std::get<GaussianNumber>(spawner.height).deviation, 6.0);
  EXPECT_EQ(constantOf(spawner.vy), 8.0);
  EXPECT_EQ(constantOf(spawner.ax), 9.0);
  EXPECT_EQ(constantOf(spawner.ay), 0.0);
  EXPECT_EQ(std::get<IntegerNumber>(spawner.mass).bound, 3);
  EXPECT_EQ(spawner.looks, (std::vector<std::uint32_t>{0, 1, 0}));
  EXPECT_EQ(spawner.count, Spawner::Count::Alive);
  EXPECT_EQ(spawner.when, Spawner::When::AfterUpdate);
  EXPECT_FALSE(spawner.limit.has_value());
  EXPECT_TRUE(spawner.prototype.removedOutside);
  EXPECT_EQ(spawner.prototype.spawner, 0U);
}

TEST(Scene, WhatAPairOfASpawnHoldsMayBeRandom) {
  const Scene scene = sceneOf("[[spawn]]\ncenter = [{ int = 640 }, 7]\nradius = 3\nvelocity = [{ spread = 1 "
                              "}, { uniform = [2, 4] }]\n"
                              "restitution = { uniform = [0.5, 1] }\nfriction = 0.25\n");
  const Spawner& spawner = scene.world.spawners[0];
  EXPECT_EQ(std::get<IntegerNumber>(spawner.x).bound, 640);
  EXPECT_EQ(constantOf(spawner.y), 7.0);
  EXPECT_EQ(std::get<SpreadNumber>(spawner.vx).half, 1.0);
  EXPECT_EQ(std::get<UniformNumber>(spawner.vy).high, 4.0);
  EXPECT_EQ(std::get<UniformNumber>(spawner.restitution.value()).low, 0.5);
  EXPECT_EQ(constantOf(spawner.friction.value()), 0.25);
  EXPECT_THAT(errorsOf("[[spawn]]\ncenter = [1]\nradius = 3\nvelocity = [{ int = 0 }, \"2\"]\nrestitution = "
                       "{ uniform = [0, 2] }\n"),
              ::testing::ElementsAre(
                  ::testing::HasSubstr("2:10: error: 'center' in [[spawn]] must be an array of 2 numbers, "
                                       "each of which may be random"),
                  ::testing::HasSubstr("4:21: error: 'velocity.int' in [[spawn]] must be"),
                  ::testing::HasSubstr(
                      "4:26: error: value 2 of 'velocity' in [[spawn]] must be a number or a random number"),
                  ::testing::HasSubstr("5:31: error: value 2 of 'restitution.uniform' in [[spawn]]")));
}

TEST(Scene, ForcesOfEveryType) {
  const Scene scene = sceneOf(
      "[[body]]\nname = \"sun\"\ncenter = [0, 0]\nradius = 1\n[[body]]\nname = \"b\"\ngroup = \"g\"\n"
      "center = [9, 0]\nradius = 1\n"
      "[[force]]\ntype = \"drag\"\nlinear = 1\nquadratic = 2\ngroup = \"g\"\n"
      "[[force]]\ntype = \"spring\"\nbody = \"b\"\nto = \"sun\"\nstiffness = 3\nlength = 4\ndamping = 5\n"
      "[[force]]\ntype = \"attract\"\nto = [6, 7]\nstrength = -8\nsoftening = 9\n"
      "[[force]]\ntype = \"wind\"\nvelocity = [10, 11]\ncoefficient = 12\n"
      "[[force]]\ntype = \"expression\"\nfx = \"x + 10*vy\"\n");
  ASSERT_EQ(scene.world.forces.size(), 5U);
  const auto& drag = std::get<DragForce>(scene.world.forces[0].kind);
  EXPECT_EQ(drag.linear, 1.0);
  EXPECT_EQ(drag.quadratic, 2.0);
  EXPECT_EQ(scene.world.forces[0].group, 1U);
  const auto& spring = std::get<SpringForce>(scene.world.forces[1].kind);
  EXPECT_EQ(spring.to.body, 0U);
  EXPECT_EQ(spring.stiffness, 3.0);
  EXPECT_EQ(spring.length, 4.0);
  EXPECT_EQ(spring.damping, 5.0);
  EXPECT_EQ(scene.world.forces[1].body, 1U);
  const auto& attract = std::get<AttractForce>(scene.world.forces[2].kind);
  EXPECT_EQ(attract.to.point, Vec2(6.0, 7.0));
  EXPECT_FALSE(attract.to.body.has_value());
  EXPECT_EQ(attract.strength, -8.0);
  EXPECT_EQ(attract.softening, 9.0);
  const auto& wind = std::get<WindForce>(scene.world.forces[3].kind);
  EXPECT_EQ(wind.velocity, Vec2(10.0, 11.0));
  EXPECT_EQ(wind.coefficient, 12.0);
  const auto& custom = std::get<CustomForce>(scene.world.forces[4].kind);
  EXPECT_EQ(custom.evaluate({{2.0, 3.0}, {4.0, 5.0}, 6.0, 7.0}), Vec2(52.0, 0.0));
}

TEST(Scene, ARecordedClockComesFromBesideTheScene) {
  const std::string folder = OFFSTAGE_SOURCE_DIR "/tests/reference/trajectories/";
  const Scene scene = parseScene("[clock]\nrecorded = \"dt/dt60.txt\"\n", folder + "a.toml");
  EXPECT_FALSE(scene.clock.isFixed());
  EXPECT_EQ(scene.clock.time(3), 0.05);
}

TEST(Scene, ViewMapsMetresAndYUpOntoPixels) {
  const Scene scene =
      sceneOf("[view]\npixels_per_metre = 40\norigin = [20, 440]\ny_up = true\n[world]\ngravity = [0, -10]\n"
              "[[body]]\ncenter = [1, 2]\nradius = 0.5\nvelocity = [3, 4]\nacceleration = [0, 1]\n"
              "[[body]]\nshape = \"rectangle\"\nposition = [1, 2]\nsize = [3, 4]\n"
              "[[spawn]]\nx = { uniform = [0, 2] }\ny = { spread = 1 }\nradius = { gaussian = [1, 0.5] }\nvy "
              "= { spread = 2 }\n"
              "[[launch]]\nat = 1\nfrom = [0, 0]\ntoward = [1, 1]\nspeed = 2\nradius = 1\n"
              "[[force]]\ntype = \"drag\"\nlinear = 3\nquadratic = 80\n"
              "[[force]]\ntype = \"spring\"\nto = [1, 1]\nstiffness = 5\nlength = 2\ndamping = 7\n"
              "[[force]]\ntype = \"attract\"\nto = [0, 0]\nstrength = 2\nsoftening = 1\n"
              "[[force]]\ntype = \"wind\"\nvelocity = [1, 1]\ncoefficient = 3\n"
              "[[force]]\ntype = \"expression\"\nfx = \"x + 100*vx\"\nfy = \"y + 100*vy\"\n");
  EXPECT_EQ(scene.world.gravity, Vec2(0.0, 400.0));
  const Body& ball = scene.world.bodies[0];
  EXPECT_EQ(ball.position, Vec2(60.0, 360.0));
  EXPECT_EQ(ball.radius, 20.0);
  EXPECT_EQ(ball.velocity, Vec2(120.0, -160.0));
  EXPECT_EQ(ball.acceleration, Vec2(0.0, -40.0));
  EXPECT_EQ(scene.world.bodies[1].position, Vec2(60.0, 360.0))
      << "the corner that is upper left on the picture";
  EXPECT_EQ(scene.world.bodies[1].size, Vec2(120.0, 160.0));
  const Spawner& spawner = scene.world.spawners[0];
  EXPECT_EQ(std::get<UniformNumber>(spawner.x).low, 20.0);
  EXPECT_EQ(std::get<UniformNumber>(spawner.x).high, 100.0);
  EXPECT_EQ(std::get<UniformNumber>(spawner.y).low, 480.0);
  EXPECT_EQ(std::get<UniformNumber>(spawner.y).high, 400.0);
  EXPECT_EQ(std::get<GaussianNumber>(spawner.radius).deviation, 20.0);
  EXPECT_EQ(std::get<SpreadNumber>(spawner.vy).half, -80.0);
  EXPECT_EQ(scene.world.launches[0].toward.point, Vec2(60.0, 400.0));
  EXPECT_EQ(scene.world.launches[0].speed, 80.0);
  EXPECT_EQ(std::get<DragForce>(scene.world.forces[0].kind).linear, 3.0);
  EXPECT_EQ(std::get<DragForce>(scene.world.forces[0].kind).quadratic, 2.0);
  EXPECT_EQ(std::get<SpringForce>(scene.world.forces[1].kind).stiffness, 5.0);
  EXPECT_EQ(std::get<SpringForce>(scene.world.forces[1].kind).length, 80.0);
  EXPECT_EQ(std::get<AttractForce>(scene.world.forces[2].kind).strength, 128000.0);
  EXPECT_EQ(std::get<AttractForce>(scene.world.forces[2].kind).softening, 40.0);
  EXPECT_EQ(std::get<WindForce>(scene.world.forces[3].kind).velocity, Vec2(40.0, -40.0));
  const auto& custom = std::get<CustomForce>(scene.world.forces[4].kind);
  EXPECT_EQ(custom.evaluate({{60.0, 360.0}, {40.0, 80.0}, 0.0, 1.0}),
            Vec2(40.0 * 101.0, -40.0 * (2.0 - 200.0)));
}

TEST(Scene, WithoutAViewNothingIsMappedToTheLastBit) {
  const std::string text = "[[body]]\ncenter = [-0.0, 0.1]\nradius = -0.0\nvelocity = [-0.0, 1e-320]\n";
  for (const std::string view : {"", "[view]\n"}) {
    const Body body = sceneOf(view + text).world.bodies[0];
    EXPECT_TRUE(std::signbit(body.position.x()));
    EXPECT_TRUE(std::signbit(body.radius));
    EXPECT_TRUE(std::signbit(body.velocity.x()));
    EXPECT_EQ(body.velocity.y(), 1e-320);
    EXPECT_EQ(body.position.y(), 0.1);
  }
}

TEST(Scene, GravityKeepsItsDefaultUnderAView) {
  EXPECT_EQ(sceneOf("[view]\npixels_per_metre = 40\ny_up = true\n").world.gravity, Vec2(0.0, 9.8));
}

TEST(Scene, CopiesOfAWorldWithExpressionsAreIndependent) {
  const Scene scene =
      sceneOf(kBall + "[[force]]\ntype = \"expression\"\nfx = \"sin(t) - x\"\nfy = \"0.1*vy\"\n");
  World world(scene.world);
  world.step(scene.clock.tick(1));
  World copy = world;
  world.step(scene.clock.tick(2));
  copy.step(scene.clock.tick(2));
  EXPECT_EQ(world.stateHash(), copy.stateHash());
}

TEST(Scene, ExactBodiesWithAClosedFormAreTaken) {
  EXPECT_EQ(sceneOf(kBall + "integrator = \"exact\"\n").world.bodies[0].integrator, Integrator::Exact);
  EXPECT_NO_THROW(sceneOf("[world]\nintegrator = \"exact\"\n" + kBall +
                          "[[force]]\ntype = \"spring\"\nto = [5, 5]\nstiffness = 2\n"));
}

} // namespace
} // namespace offstage
