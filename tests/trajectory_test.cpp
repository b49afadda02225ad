// Every case of the reference trajectories, bit for bit: a JVM on the lecture's programs.
#include "src/sim/world.h"
#include "tests/support/oracle_case.h"
#include "tests/support/reference_csv.h"
#include "tests/support/sim_setup.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

struct Case {
  std::string name;
  std::string dt;
  std::string folder;
  std::int64_t seed;
  std::int64_t stride; ///< the reference holds every stride-th frame
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name << " with " << c.dt;
}

class Trajectory : public testing::TestWithParam<Case> {};

TEST_P(Trajectory, EqualsTheJvmBitForBit) {
  const Case& c = GetParam();
  const std::filesystem::path folder = referenceFolder() / c.folder;
  const bool original = c.folder != "more";
  const Clock clock =
      oracleClock((original ? referenceFolder() / "trajectories/dt" : folder) / (c.dt + ".txt"));
  EXPECT_EQ(compareWithOracle(oracleSetup(c.name, c.seed), clock, folder / (c.name + "__" + c.dt), c.stride),
            "");
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* name : {"1_fall", "2a_bounce", "2b_bounce_naive", "3_spawn", "4a_spawn_gravity_bounce",
                           "5a_vanish_mark_counter", "6a_elastic", "6g_elastic_separate", "7_projectile"}) {
    all.push_back({name, "dt60", "trajectories/out", 2022, 1});
  }
  all.push_back({"1_fall", "dtfx", "trajectories/out", 2022, 1});
  all.push_back({"2a_bounce", "dtfx", "trajectories/out", 2022, 1});
  for (const char* name :
       {"2d_bounce_naive_g980", "4b_update_then_spawn", "5b_vanish_mark_listsize", "5c_triple_mark",
        "5d_triple_immediate", "6b_elastic_nocheck", "6c_printed_literal", "6d_printed_check",
        "6e_elastic_set16", "6f_elastic_ideal8"}) {
    all.push_back({name, "dtjitter", "more", 7, 20});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Oracle, Trajectory, testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name + "_" + test.param.dt; });

/// Case 8: the same motion by three methods and exactly.
class IntegratorTrajectory : public testing::TestWithParam<std::string> {};

WorldSetup integratorSetup(const std::string& problem) {
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  Body body;
  if (problem == "projectile") {
    setup.gravity = Vec2(0.0, 9.8);
    body.position = Vec2(40, 440);
    body.velocity = Vec2(55, -75);
  } else if (problem == "oscillator") {
    body.position = Vec2(470, 240);
    body.velocity = Vec2(0, 100);
    addForce(setup, {SpringForce{.to = {Vec2(320, 240), {}}, .stiffness = 4.0}, {}, {}});
  } else {
    body.position = Vec2(470, 240);
    body.velocity = Vec2(0, 300);
    addForce(setup,
             {AttractForce{.to = {Vec2(320, 240), {}}, .strength = 4.0 * 150.0 * 150.0 * 150.0}, {}, {}});
  }
  for (const Integrator method :
       {Integrator::ExplicitEuler, Integrator::SemiImplicitEuler, Integrator::Rk4, Integrator::Exact}) {
    body.integrator = method;
    setup.bodies.push_back(body);
  }
  return setup;
}

TEST_P(IntegratorTrajectory, EqualsTheJvmBitForBitAndTheExactOneTo1e9) {
  const ReferenceCsv reference(referenceFolder() / "trajectories/out" /
                               ("8_" + GetParam() + "__dt60.csv.gz"));
  const Clock clock = oracleClock(referenceFolder() / "trajectories/dt/dt60.txt");
  World world(integratorSetup(GetParam()));
  double worst = 0.0;
  std::size_t row = 0;
  for (std::int64_t frame = 0; frame <= clock.steps(); ++frame) {
    if (frame > 0) world.step(clock.tick(frame));
    for (const Body& body : world.bodies()) {
      ASSERT_EQ(reference.integer(row, "frame"), frame);
      const Vec2 position(reference.hex(row, "x_hex"), reference.hex(row, "y_hex"));
      const Vec2 velocity(reference.hex(row, "vx_hex"), reference.hex(row, "vy_hex"));
      if (body.integrator == Integrator::Exact) {
        ASSERT_EQ(reference.cell(row, "method"), "exact");
        worst = std::max(worst, length(body.position - position));
        worst = std::max(worst, length(body.velocity - velocity));
      } else {
        ASSERT_TRUE(sameBits(body.position.x(), position.x()) && sameBits(body.position.y(), position.y()) &&
                    sameBits(body.velocity.x(), velocity.x()) && sameBits(body.velocity.y(), velocity.y()))
            << "frame " << frame << ' ' << reference.cell(row, "method") << ": " << show(body.position.x())
            << ' ' << show(body.position.y()) << " instead of " << show(position.x()) << ' '
            << show(position.y());
      }
      ++row;
    }
  }
  EXPECT_EQ(row, reference.rows());
  EXPECT_LT(worst, 1e-9) << "px (or px/s) between the exact motion and the reference's";
}

INSTANTIATE_TEST_SUITE_P(Oracle, IntegratorTrajectory, testing::Values("projectile", "oscillator", "orbit"),
                         [](const auto& test) { return test.param; });

} // namespace
} // namespace offstage::test
