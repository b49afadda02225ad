// Many continuous bodies at once: whom each of them meets, and what that costs.

#include "src/sim/contact.h"
#include "src/sim/impact_time.h"
#include "src/sim/tournament.h"
#include "src/sim/world.h"
#include "tests/support/allocation_count.h"
#include "tests/support/sim_setup.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

constexpr double kFrame = 1.0 / 60.0;

/// Circles on a square lattice with gaps as wide as they are, which fly in all directions. A third of them
/// may be heavy, and throw the others far.
WorldSetup crowd(int columns, double speed, double heaviest, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  setup.groups = {"crowd"};
  setup.contacts = {{.groupA = 0, .groupB = 0}};
  for (int i = 0; i < columns * columns; ++i) {
    Body body =
        circle(20.0 + 12.0 * (i % columns) + share(random), 20.0 + 12.0 * (i / columns) + share(random), 3.0,
               Vec2(share(random) * speed, share(random) * speed), i % 3 == 0 ? heaviest : 1.0);
    body.continuous = i % 2 == 0;
    setup.bodies.push_back(body);
  }
  return setup;
}

/// The same step as a double loop over all pairs from impact to impact.
std::size_t stepByDoubleLoop(std::vector<Body>& bodies, const ContactRule& rule, double h) {
  std::size_t impacts = 0;
  for (double now = 0.0;; ++impacts) {
    std::optional<Impact> soonest;
    std::pair<std::size_t, std::size_t> pair;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < bodies.size(); ++j) {
        if (!bodies[i].continuous && !bodies[j].continuous) continue;
        const auto impact =
            timeOfImpact(bodies[i], bodies[i].velocity, bodies[j], bodies[j].velocity, h - now);
        if (!impact || (soonest && soonest->time <= impact->time)) continue;
        soonest = impact;
        pair = {i, j};
      }
    }
    const double part = soonest ? soonest->time : h - now;
    for (Body& body : bodies) body.position += body.velocity * part;
    now += part;
    if (!soonest) return impacts;
    respond(rule, {soonest->normal, 0.0, 0.0}, bodies[pair.first], bodies[pair.second]);
  }
}

TEST(SweptCrowd, MeetsAsADoubleLoopFromImpactToImpactDoes) {
  for (const double speed : {300.0, 3000.0}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      WorldSetup setup = crowd(8, speed, 1000.0, seed);
      setup.contacts[0].separate = false; // of the ordinary contacts, which follow
      World world(setup);
      world.step({1, kFrame, kFrame});
      std::vector<Body> expected = setup.bodies;
      const std::size_t impacts = stepByDoubleLoop(expected, setup.contacts[0], kFrame);
      std::size_t swept = 0; // those that overlap where the step ends were not
      for (const Event& event : world.events()) swept += event.p == 6.0 ? 1U : 0U;
      ASSERT_EQ(swept, impacts) << "at " << speed << " px/s, seed " << seed;
      for (const Body& body : world.bodies()) {
        EXPECT_NEAR(length(body.position - expected[body.id].position), 0.0, 1e-6)
            << "body " << body.id << " at " << speed << " px/s, seed " << seed << ", after " << impacts
            << " impacts";
      }
    }
  }
}

TEST(SweptCrowd, TakesMemoryForNeighboursNotForEverybody) {
  if (!bytesHeld()) GTEST_SKIP() << "the sanitizer's own operator new does not count";
  WorldSetup setup = crowd(60, 400.0, 1.0, 1);
  for (Body& body : setup.bodies) body.continuous = true;
  const std::ptrdiff_t before = *bytesHeld();
  World world(setup);
  std::size_t impacts = 0;
  for (int frame = 1; frame <= 3; ++frame) {
    world.step({frame, frame * kFrame, kFrame});
    impacts += world.events().size();
  }
  EXPECT_GT(impacts, 2000U);
  EXPECT_LT((*bytesHeld() - before) / static_cast<std::ptrdiff_t>(setup.bodies.size()), 3000)
      << "bytes a body";
}

TEST(Tournament, IsWonByTheFirstOfAllWhateverChanges) {
  std::mt19937_64 random(7);
  for (const std::size_t players : {1U, 2U, 3U, 7U, 64U, 100U}) {
    std::vector<int> scores(players, 5);
    const auto isBefore = [&](std::uint32_t a, std::uint32_t b) { return scores[a] < scores[b]; };
    Tournament tournament;
    tournament.begin(players, isBefore);
    for (int change = 0; change < 500; ++change) {
      const std::size_t player = random() % players;
      scores[player] = static_cast<int>(random() % 10);
      tournament.playAgain(player, isBefore);
      const auto first = std::min_element(scores.begin(), scores.end()); // of equal ones the first
      ASSERT_EQ(tournament.winner(), static_cast<std::uint32_t>(first - scores.begin()))
          << players << " players, change " << change;
    }
  }
}

TEST(Tournament, WithoutPlayersIsWonByNobody) {
  Tournament tournament;
  tournament.begin(0, [](std::uint32_t, std::uint32_t) { return false; });
  EXPECT_EQ(tournament.winner(), Tournament::kNobody);
}

} // namespace
} // namespace offstage::test
