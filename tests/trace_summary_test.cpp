#include "src/scene/trace_summary.h"
#include "tests/support/scene_text.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string summaryOf(const std::string& text) {
  const Scene scene = sceneOf(text);
  World world(scene.world);
  TraceSummary summary(scene.world);
  summary.add(world);
  while (world.frame() < scene.clock.steps()) {
    world.step(scene.clock.tick(world.frame() + 1));
    summary.add(world);
  }
  return summary.text();
}

TEST(TraceSummary, ExactMotionKeepsItsEnergy) {
  // Two units of mass fall 1 s with g = 10 from rest, 100 px above the floor: E = 2·10·100.
  const std::string text =
      summaryOf("duration = 1\n[clock]\nfps = 4\n[world]\ngravity = [0, 10]\nintegrator = 'exact'\n"
                "[[body]]\ncenter = [0, 380]\nradius = 5\nmass = 2\n");
  EXPECT_THAT(text, HasSubstr("frames     0 … 4, 1 s\n"));
  EXPECT_THAT(text, HasSubstr("bodies     1 → 1; 0 came, 0 went\n"));
  EXPECT_THAT(text, HasSubstr("momentum   (0, 0) → (0, 20) mass·px/s\n"));
  EXPECT_THAT(text, HasSubstr("kinetic    0 → 100 mass·px²/s²\n"));
  EXPECT_THAT(text, HasSubstr("potential  2000 → 1900 mass·px²/s²\n"));
  EXPECT_THAT(text,
              HasSubstr("drift      at most 0 mass·px²/s², 0 of the energy at the start, in frame 0\n"));
  EXPECT_THAT(text, HasSubstr("contacts   0 collisions, 0 hits, 0 touches, 0 at walls\noverlap    none\n"));
}

TEST(TraceSummary, EulersGainIsItsDrift) {
  // Explicit Euler's x lags behind by g·h·t/2 a step: after 1 s with h = 1/4 and g = 10 by 1.25 px, E =
  // m·g·1.25.
  const std::string text =
      summaryOf("duration = 1\n[clock]\nfps = 4\n[world]\ngravity = [0, 10]\nintegrator = 'explicit-euler'\n"
                "[[body]]\ncenter = [0, 380]\nradius = 5\n");
  EXPECT_THAT(text, HasSubstr("energy     1000 → 1012.5 mass·px²/s²\n"));
  EXPECT_THAT(
      text,
      HasSubstr("drift      at most 12.5 mass·px²/s², 0.0125 of the energy at the start, in frame 4\n"));
}

TEST(TraceSummary, CountsWhatHappensAndFindsTheDeepestOverlap) {
  // Two circles of radius 5 meet at 2·10 px/s a quarter of a second: centres 12 apart, then 7: 3 px deep, 0.6
  // r.
  const std::string text = summaryOf("duration = 1\n[clock]\nfps = 4\n[world]\ngravity = [0, 0]\n"
                                     "[[body]]\ncenter = [100, 100]\nradius = 5\nvelocity = [10, 0]\n"
                                     "[[body]]\ncenter = [112, 100]\nradius = 5\nvelocity = [-10, 0]\n"
                                     "[[collide]]\nbetween = ['bodies', 'bodies']\nseparate = false\n");
  EXPECT_THAT(text, HasSubstr("contacts   1 collisions"));
  EXPECT_THAT(text,
              HasSubstr("overlap    at most 3 px, 0.6 of the smaller radius, bodies 0 and 1 in frame 1\n"));
}

TEST(TraceSummary, WhatIsNoNumberHasNoSign) {
  const std::string text = summaryOf("duration = 1\n[[body]]\ncenter = [100, 100]\nradius = 5\n"
                                     "[[force]]\ntype = 'expression'\nfx = '0/0'\n");
  EXPECT_THAT(text, HasSubstr("momentum   (0, 0) → (nan, "));
  EXPECT_THAT(text, Not(HasSubstr("-nan")));
}

TEST(TraceSummary, TellsOfBodiesThatComeAndGo) {
  const std::string text =
      summaryOf("duration = 3\n[walls]\nbottom = 1\n"
                "[[spawn]]\nx = 50\ny = 100\nradius = 5\nlimit = 2\n"
                "[[body]]\ncenter = [639, 5]\nradius = 2\nvelocity = [100, 0]\nleaving = 'remove'\n");
  EXPECT_THAT(text, HasSubstr("bodies     1 → 2; 2 came, 1 went\n"));
}

TEST(TraceSummary, WhatBodiesBringOrTakeAlongIsNoDrift) {
  // Exact motion keeps its energy; spawned bodies bring theirs, and one takes its own along.
  const std::string exact =
      summaryOf("duration = 3\n[world]\ngravity = [0, 10]\nintegrator = 'exact'\n"
                "[[spawn]]\nx = 50\ny = 100\nradius = 5\nlimit = 2\n"
                "[[body]]\ncenter = [630, 5]\nradius = 2\nvelocity = [100, 0]\nleaving = 'remove'\n");
  EXPECT_THAT(exact, HasSubstr("2 came, 1 went\n"));
  EXPECT_THAT(exact, HasSubstr("; without 3 frames in which bodies came or went\n"));
  const std::size_t begin = exact.find("drift      at most ") + 19;
  EXPECT_LT(std::stod(exact.substr(begin)), 1e-6) << exact;
  // Euler's error of the other frames stays.
  const std::string euler =
      summaryOf("duration = 1\n[clock]\nfps = 4\n[world]\ngravity = [0, 10]\nintegrator = "
                "'explicit-euler'\n[[body]]\ncenter = [0, 380]\nradius = 5\n"
                "[[launch]]\nat = 1\nfrom = [100, 100]\ntoward = [200, 100]\nspeed = 1000\nradius = 1\n");
  EXPECT_THAT(euler, HasSubstr("drift      at most 9.375 mass·px²/s²"));
}

} // namespace
} // namespace offstage::test
