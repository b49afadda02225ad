#include "src/sim/spring_stability.h"
#include "src/sim/spring_watch.h"
#include "tests/support/sim_setup.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

struct Limit {
  Integrator method;
  double steps; ///< h·frequency
};

TEST(SpringStability, UndampedLimitsAreThoseOfTheTextbooks) {
  for (const auto& [method, steps] :
       {Limit{Integrator::SemiImplicitEuler, 2.0}, Limit{Integrator::Verlet, 2.0},
        Limit{Integrator::Rk4, 2.0 * std::numbers::sqrt2}}) {
    for (const double frequency : {0.5, 20.0, 3000.0}) {
      const double h = longestStep(method, frequency, 0.0, 10.0 / frequency);
      EXPECT_NEAR(h * frequency, steps, 1e-4) << static_cast<int>(method);
      EXPECT_FALSE(isTooLong(method, frequency, 0.0, 0.999 * h));
      EXPECT_TRUE(isTooLong(method, frequency, 0.0, 1.001 * h));
    }
  }
}

TEST(SpringStability, WhatGrowsWithAnyStepIsTooLongWhenItDoublesInASwing) {
  // |R(iy)|² = 1 + y² and 1 + y⁴/4, 2π/y steps a swing.
  const auto grown = [](Integrator method, double y) {
    const double square = method == Integrator::ExplicitEuler ? y * y : 0.25 * y * y * y * y;
    return std::pow(1.0 + square, std::numbers::pi / y);
  };
  for (const auto& [method, expected] :
       {Limit{Integrator::ExplicitEuler, 0.2262}, Limit{Integrator::Midpoint, 0.9956}}) {
    const double y = longestStep(method, 7.0, 0.0, 1.0) * 7.0;
    EXPECT_NEAR(grown(method, y), 2.0, 1e-6);
    EXPECT_NEAR(y, expected, 1e-4);
    EXPECT_FALSE(isTooLong(method, 7.0, 0.0, 0.5 * y / 7.0));
  }
}

TEST(SpringStability, DampingShortensTheStepOfSemiImplicitEuler) {
  // The eigenvalues of its step stay within the unit circle while h²·frequency² + 2·h·damping ≤ 4 (Jury).
  for (const double damping : {0.1, 5.0, 60.0}) {
    const double frequency = 20.0;
    const double h = longestStep(Integrator::SemiImplicitEuler, frequency, damping, 1.0);
    EXPECT_NEAR(h * h * frequency * frequency + 2.0 * h * damping, 4.0, 1e-6) << damping;
  }
}

TEST(SpringStability, TheClosedFormHasNoLimit) {
  EXPECT_FALSE(isTooLong(Integrator::Exact, 1e6, 0.0, 10.0));
  EXPECT_FALSE(isTooLong(Integrator::Rk4, 0.0, 0.0, 10.0)) << "no spring";
  EXPECT_TRUE(isTooLong(Integrator::Rk4, 1e300, 0.0, 1e300)) << "beyond all numbers";
}

WorldSetup springs(const std::vector<SpringForce>& forces) {
  WorldSetup setup;
  for (const SpringForce& force : forces) addForce(setup, {force, {}, {}});
  return setup;
}

double frequencyOf(const WorldSetup& setup, const std::vector<Body>& bodies) {
  std::vector<Body> numbered = bodies;
  for (std::size_t i = 0; i < numbered.size(); ++i) numbered[i].id = static_cast<std::uint32_t>(i);
  const auto warning = SpringWatch(setup).find(numbered, 10.0);
  return warning ? std::get<LongStep>(warning->what).frequency : 0.0;
}

TEST(SpringWatch, FrequencyIsThatOfTheBodyOnAllItsSprings) {
  const SpringForce weak{{Vec2(0, 0), {}}, 9.0, 0.0, 0.0};
  const SpringForce strong{{Vec2(10, 0), {}}, 16.0, 0.0, 0.0};
  const std::vector<Body> one{circle(5, 5, 1)};
  EXPECT_EQ(frequencyOf(springs({weak}), one), 3.0);
  EXPECT_EQ(frequencyOf(springs({weak, strong}), one), 5.0);
  const SpringForce along{{Vec2(10, 0), {}}, 16.0, 20.0, 0.0};
  EXPECT_EQ(frequencyOf(springs({along, along}), one), 4.0) << "they may pull across each other";
  EXPECT_EQ(frequencyOf(springs({}), one), 0.0);
  // Two bodies on one spring swing against each other: stiffness·(1/m1 + 1/m2).
  WorldSetup pair = springs({{{Vec2::Zero(), 0U}, 12.0, 30.0, 0.0}});
  pair.forces[0].body = 1;
  const std::vector<Body> two{circle(0, 0, 1, Vec2::Zero(), 4.0), circle(30, 0, 1)};
  EXPECT_EQ(frequencyOf(pair, two), std::sqrt(15.0));
  std::vector<Body> held = two;
  held[0].fixed = true;
  EXPECT_EQ(frequencyOf(pair, held), std::sqrt(12.0));
}

TEST(SpringWatch, LooksAgainWhenTheStepIsLongerOrABodyComes) {
  SpringWatch watch(springs({{{Vec2(0, 0), {}}, 100.0, 0.0, 0.0}})); // stable up to 0.2 s at mass 1
  std::vector<Body> bodies{circle(5, 5, 1)};
  EXPECT_FALSE(watch.find(bodies, 0.1));
  EXPECT_TRUE(watch.find(bodies, 0.25));
  EXPECT_FALSE(watch.find(bodies, 0.1));
  bodies.push_back(circle(9, 9, 1, Vec2::Zero(), 0.1));
  bodies[1].id = 1;
  const auto warning = watch.find(bodies, 0.1);
  ASSERT_TRUE(warning);
  EXPECT_EQ(warning->body, 1U);
}

} // namespace
} // namespace offstage::test
