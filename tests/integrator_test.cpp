#include "src/sim/closed_form.h"
#include "src/sim/error.h"
#include "src/sim/integrator.h"
#include "src/sim/world.h"
#include "tests/support/sim_setup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

constexpr double kSeconds = 4.0;
const std::array<double, 3> kRates{30.0, 60.0, 240.0}; ///< three step sizes

Body thrown(Integrator integrator) {
  Body body;
  body.position = Vec2(40, 440);
  body.velocity = Vec2(55, -75);
  body.radius = 10;
  body.integrator = integrator;
  return body;
}

World run(const WorldSetup& setup, double fps, double seconds = kSeconds) {
  const Clock clock = Clock::fixed(fps, static_cast<std::int64_t>(std::lround(fps * seconds)));
  World world(setup);
  for (std::int64_t frame = 1; frame <= clock.steps(); ++frame) world.step(clock.tick(frame));
  return world;
}

TEST(Integrator, FreeFallAndThrowFollowTheClosedFormAtThreeStepSizes) {
  for (const double fps : kRates) {
    for (const Vec2& velocity : {Vec2(0, 0), Vec2(55, -75)}) {
      WorldSetup setup;
      for (const Integrator method :
           {Integrator::ExplicitEuler, Integrator::SemiImplicitEuler, Integrator::Verlet,
            Integrator::Midpoint, Integrator::Rk4, Integrator::Exact}) {
        setup.bodies.push_back(thrown(method));
        setup.bodies.back().velocity = velocity;
      }
      const World world = run(setup, fps);
      const double t = world.time();
      const Vec2 expected = Vec2(40, 440) + velocity * t + Vec2(0, 0.5 * 9.8 * t * t);
      for (const Body& body : world.bodies()) {
        // Euler's error under constant acceleration is known: g·h·t/2, behind or ahead.
        double known = 0.0;
        if (body.integrator == Integrator::ExplicitEuler) known = -9.8 / fps * t / 2.0;
        if (body.integrator == Integrator::SemiImplicitEuler) known = 9.8 / fps * t / 2.0;
        EXPECT_NEAR(body.position.x(), expected.x(), 1e-9) << "method " << static_cast<int>(body.integrator);
        EXPECT_NEAR(body.position.y(), expected.y() + known, 1e-9)
            << "method " << static_cast<int>(body.integrator) << " at " << fps << " fps";
        EXPECT_NEAR(body.velocity.y(), velocity.y() + 9.8 * t, 1e-10);
      }
    }
  }
}

TEST(Integrator, SpringAndCircularOrbitFollowTheClosedFormAtThreeStepSizes) {
  for (const double fps : kRates) {
    for (const bool spring : {true, false}) {
      WorldSetup setup;
      setup.gravity = Vec2::Zero();
      Body body = thrown(Integrator::Exact);
      body.position = Vec2(470, 240);
      body.velocity = Vec2(0, 300);
      setup.bodies = {body, body};
      setup.bodies[1].integrator = Integrator::Rk4;
      const Anchor centre{Vec2(320, 240), {}};
      if (spring) {
        addForce(setup, {SpringForce{.to = centre, .stiffness = 4.0}, {}, {}});
      } else {
        addForce(setup, {AttractForce{.to = centre, .strength = 4.0 * 150.0 * 150.0 * 150.0}, {}, {}});
      }
      const World world = run(setup, fps);
      // With v0 = ω·r both are the same circle, of angular speed ω = 2.
      const double angle = 2.0 * world.time();
      const Vec2 expected(320 + 150 * std::cos(angle), 240 + 150 * std::sin(angle));
      EXPECT_LT(length(world.bodies()[0].position - expected), 1e-9)
          << (spring ? "spring" : "orbit") << fps << " fps";
      const double h = 1.0 / fps;
      EXPECT_LT(length(world.bodies()[1].position - expected), 1e4 * h * h * h * h)
          << "RK4, " << (spring ? "spring " : "orbit ") << fps << " fps";
    }
  }
}

TEST(Integrator, ExactSpringSwingsAboutTheCentreThatGravityShifts) {
  WorldSetup setup;
  setup.gravity = Vec2(0, 98);
  Body body = thrown(Integrator::Exact);
  body.mass = 2.0;
  body.acceleration = Vec2(6, 0);
  setup.bodies = {body, body};
  setup.bodies[1].integrator = Integrator::Rk4;
  addForce(setup, {SpringForce{.to = {Vec2(320, 240), {}}, .stiffness = 8.0}, {}, {}});
  const World world = run(setup, 2000);
  EXPECT_LT(length(world.bodies()[0].position - world.bodies()[1].position), 1e-7);
  EXPECT_LT(length(world.bodies()[0].velocity - world.bodies()[1].velocity), 1e-7);
}

TEST(Integrator, ExactRectangleSwingsWithItsCentre) {
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  Body box = thrown(Integrator::Exact);
  box.shape = Shape::Rectangle;
  box.size = Vec2(40, 20);
  box.position = Vec2(320 - 20, 240 - 10); // the centre is where nothing pulls
  box.velocity = Vec2::Zero();
  setup.bodies = {box, box};
  setup.bodies[1].integrator = Integrator::Rk4;
  addForce(setup, {SpringForce{.to = {Vec2(320, 240), {}}, .stiffness = 8.0}, {}, {}});
  const World world = run(setup, 60);
  for (const Body& body : world.bodies()) EXPECT_EQ(body.position, box.position);
}

WorldSetup ellipse(const Vec2& velocity) {
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  Body body = thrown(Integrator::Exact);
  body.position = Vec2(470, 240);
  body.velocity = velocity;
  setup.bodies = {body, body};
  setup.bodies[1].integrator = Integrator::Rk4;
  addForce(setup, {AttractForce{.to = {Vec2(320, 240), {}}, .strength = 1.35e7}, {}, {}});
  return setup;
}

TEST(Integrator, ExactEllipseEqualsRk4WithTinySteps) {
  for (const Vec2& velocity : {Vec2(0, 250), Vec2(100, 200), Vec2(-80, 330), Vec2(30, -380)}) {
    const World world = run(ellipse(velocity), 5000);
    EXPECT_LT(length(world.bodies()[0].position - world.bodies()[1].position), 1e-6)
        << "start " << velocity.transpose();
  }
}

TEST(Integrator, ExactEllipseKeepsEnergyAndAngularMomentum) {
  for (const Vec2& velocity : {Vec2(0, 300), Vec2(0, 60), Vec2(100, 200), Vec2(-380, 20)}) {
    WorldSetup setup = ellipse(velocity);
    setup.bodies.resize(1);
    const Clock clock = Clock::fixed(60, 6000);
    World world(setup);
    const auto energy = [&] {
      const Body& b = world.bodies()[0];
      return 0.5 * dot(b.velocity, b.velocity) - 1.35e7 / length(b.position - Vec2(320, 240));
    };
    const auto momentum = [&] {
      const Body& b = world.bodies()[0];
      const Vec2 d = b.position - Vec2(320, 240);
      return d.x() * b.velocity.y() - d.y() * b.velocity.x();
    };
    const double e0 = energy();
    const double l0 = momentum();
    double worst = 0.0;
    for (std::int64_t frame = 1; frame <= clock.steps(); ++frame) {
      world.step(clock.tick(frame));
      // Near the centre the energy is a small difference of large terms; it is held to their size.
      const Body& b = world.bodies()[0];
      const double scale = 0.5 * dot(b.velocity, b.velocity) + std::abs(e0);
      worst = std::max({worst, std::abs(energy() - e0) / scale, std::abs(momentum() / l0 - 1.0)});
    }
    EXPECT_LT(worst, 1e-10) << "start " << velocity.transpose();
  }
}

TEST(Integrator, ExactEllipseReturnsAfterItsPeriodFromAnyRateOfFrames) {
  WorldSetup setup = ellipse(Vec2(60, 220));
  setup.bodies.resize(1);
  const double semiMajor = 1.0 / (2.0 / 150.0 - (60.0 * 60.0 + 220.0 * 220.0) / 1.35e7);
  const double period = 2.0 * 3.14159265358979323846 * std::sqrt(semiMajor * semiMajor * semiMajor / 1.35e7);
  for (const int steps : {1, 7, 1000}) {
    World world(setup);
    for (int i = 1; i <= steps; ++i) world.step({i, 100.0 * period * i / steps, 100.0 * period / steps});
    EXPECT_LT(length(world.bodies()[0].position - Vec2(470, 240)), 1e-8) << steps << " steps for 100 turns";
  }
}

TEST(Integrator, ExactStartsAnewAtWallsAndStaysOnTheParabola) {
  // Dropped on a floor that gives back half: between bounces every frame is on the parabola of its flight.
  WorldSetup setup;
  setup.gravity = Vec2(0, 100);
  Body body = thrown(Integrator::Exact);
  body.position = Vec2(320, 400);
  body.velocity = Vec2(0, 0);
  setup.bodies = {body};
  setup.walls.restitution[3] = 0.5;
  World world(setup);
  const Clock clock = Clock::fixed(100, 400);
  Vec2 anchor = body.position;
  Vec2 speed = body.velocity;
  double since = 0.0;
  int bounces = 0;
  for (std::int64_t frame = 1; frame <= clock.steps(); ++frame) {
    world.step(clock.tick(frame));
    const Body& b = world.bodies()[0];
    if (!world.events().empty()) {
      ++bounces;
      anchor = b.position;
      speed = b.velocity;
      since = world.time();
    }
    const double t = world.time() - since;
    EXPECT_NEAR(b.position.y(), anchor.y() + speed.y() * t + 50.0 * t * t, 1e-9) << "frame " << frame;
  }
  EXPECT_GE(bounces, 2);
}

TEST(Integrator, WithoutCouplingSeparateAndCommonStagesGiveTheSameBits) {
  WorldSetup apart;
  for (const Integrator method :
       {Integrator::ExplicitEuler, Integrator::SemiImplicitEuler, Integrator::Verlet, Integrator::Midpoint,
        Integrator::Rk4, Integrator::Exact}) {
    apart.bodies.push_back(thrown(method));
    if (method == Integrator::Exact) apart.bodies.back().group = 1;
  }
  apart.groups = {"dragged", "free", "pair"};
  addForce(apart, {DragForce{.linear = 0.2, .quadratic = 0.001}, 0U, {}});
  addForce(apart, {SpringForce{.to = {Vec2(320, 240), {}}, .stiffness = 3.0, .length = 50.0}, 0U, {}});
  WorldSetup together =
      apart; // with a pair that nothing else is tied to, everybody goes through the stages together
  Body one = thrown(Integrator::Rk4);
  one.group = 2;
  together.bodies.push_back(one);
  one.position += Vec2(30, 0);
  together.bodies.push_back(one);
  addForce(together, {SpringForce{.to = {Vec2::Zero(), 6U}, .stiffness = 3.0}, {}, 7U});
  const World a = run(apart, 60);
  const World b = run(together, 60);
  for (std::size_t i = 0; i < a.bodies().size(); ++i) {
    EXPECT_EQ(a.bodies()[i].position, b.bodies()[i].position) << "method " << i;
    EXPECT_EQ(a.bodies()[i].velocity, b.bodies()[i].velocity) << "method " << i;
  }
}

struct Refusal {
  std::string part; ///< of the reason
  Force force;
  Vec2 velocity = Vec2(0, 300);
  Vec2 gravity = Vec2::Zero();
};

TEST(Integrator, ExactSaysWhyABodyHasNoClosedForm) {
  const Anchor centre{Vec2(320, 240), {}};
  const Anchor other{Vec2::Zero(), 1U};
  const std::vector<Refusal> refusals{
      {"drag", {DragForce{.linear = 0.1}, {}, {}}},
      {"wind", {WindForce{Vec2(1, 0), 0.1}, {}, {}}},
      {"custom", {CustomForce{[](const ForceState&) { return Vec2(0, 0); }}, {}, {}}},
      {"length", {SpringForce{.to = centre, .stiffness = 1.0, .length = 5.0}, {}, {}}},
      {"damped", {SpringForce{.to = centre, .stiffness = 1.0, .damping = 0.5}, {}, {}}},
      {"tied to a body", {SpringForce{.to = other, .stiffness = 1.0}, {}, 0U}},
      {"hangs on it", {SpringForce{.to = {Vec2::Zero(), 0U}, .stiffness = 1.0}, {}, 1U}},
      {"to a body", {AttractForce{.to = other, .strength = 1.0}, {}, 0U}},
      {"softened", {AttractForce{.to = centre, .strength = 1.35e7, .softening = 1.0}, {}, {}}},
      {"repelled", {AttractForce{.to = centre, .strength = -1.35e7}, {}, {}}},
      {"beside the attraction",
       {AttractForce{.to = centre, .strength = 1.35e7}, {}, {}},
       Vec2(0, 300),
       Vec2(0, 9.8)},
      {"escape", {AttractForce{.to = centre, .strength = 1.35e7}, {}, {}}, Vec2(0, 500)},
      {"straight", {AttractForce{.to = centre, .strength = 1.35e7}, {}, {}}, Vec2(-50, 0)}};
  for (const Refusal& refusal : refusals) {
    WorldSetup setup;
    setup.gravity = refusal.gravity;
    Body body = thrown(Integrator::Exact);
    body.position = Vec2(470, 240);
    body.velocity = refusal.velocity;
    Body second = thrown(Integrator::Rk4);
    second.id = 1;
    setup.bodies = {body, second};
    addForce(setup, refusal.force);
    const auto problem = closedFormProblem(setup, setup.bodies[0]);
    ASSERT_TRUE(problem.has_value()) << refusal.part;
    EXPECT_NE(problem->find(refusal.part), std::string::npos) << *problem;
    try {
      const World world(setup);
      ADD_FAILURE() << "no error for " << refusal.part;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::BadInput);
      EXPECT_NE(std::string(error.what()).find("body 0"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(refusal.part), std::string::npos) << error.what();
    }
  }
  WorldSetup two;
  two.bodies = {thrown(Integrator::Exact)};
  for (int i = 0; i < 2; ++i) addForce(two, {SpringForce{.to = centre, .stiffness = 1.0}, {}, {}});
  EXPECT_EQ(closedFormProblem(two, two.bodies[0]), "several forces act on it");
}

TEST(Integrator, ExactIgnoresForcesThatDoNotActOnIt) {
  WorldSetup setup;
  setup.groups = {"free", "dragged"};
  setup.bodies = {thrown(Integrator::Exact)};
  addForce(setup, {DragForce{.linear = 0.1}, 1U, {}});
  addForce(setup, {DragForce{}, {}, {}}); // no drag at all
  EXPECT_EQ(closedFormProblem(setup, setup.bodies[0]), std::nullopt);
}

TEST(Integrator, ExactReportsAnOrbitThatACollisionTurnsIntoAnEscape) {
  WorldSetup setup = ellipse(Vec2(0, 300));
  setup.bodies.resize(1);
  setup.groups = {"planet", "hammer"};
  Body hammer = thrown(Integrator::SemiImplicitEuler);
  hammer.group = 1;
  hammer.mass = 1000.0;
  hammer.position = Vec2(470, 200);
  hammer.velocity = Vec2(0, 900);
  setup.bodies.push_back(hammer);
  setup.forces[0].group = 0;
  setup.contacts.push_back({.groupA = 0, .groupB = 1});
  EXPECT_THROW(run(setup, 60), Error);
}

} // namespace
} // namespace offstage::test
