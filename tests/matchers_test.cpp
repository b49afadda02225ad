#include "render/draw/image.h"
#include "render/stage/include/offstage/testing.h"
#include "tests/support/child_process.h"
#include "tests/support/process.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::AllOf;
using ::testing::DescribeMatcher;
using ::testing::ElementsAre;
using ::testing::ExplainMatchResult;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// What a matcher says of a value.
template <class Matcher, class Value>
std::string explained(const Matcher& matcher, const Value& value) {
  ::testing::StringMatchResultListener listener;
  static_cast<void>(ExplainMatchResult(matcher, value, &listener));
  return listener.str();
}

/// A white frame with one pixel of another colour.
Frame specked(int x, int y) {
  Frame frame = flatFrame(8, 6, {255, 255, 255, 255});
  frame.rgba[4 * pixelIndex(y, 8, x)] = 0;
  return frame;
}

TEST(IsNearMatcher, HoldsVectorsToADistance) {
  EXPECT_THAT(Vec2(1, 2), IsNear(Vec2(1, 2), 0.0));
  EXPECT_THAT(Vec2(4, 6), IsNear(Vec2(1, 2), 5.0));
  EXPECT_THAT(Vec2(4, 6), Not(IsNear(Vec2(1, 2), 4.999)));
  EXPECT_THAT(Vec2(std::numeric_limits<double>::quiet_NaN(), 0), Not(IsNear(Vec2(0, 0), 1e300)));
  EXPECT_EQ(explained(IsNear(Vec2(1, 2), 0.5), Vec2(4, 6)), "which is (4, 6), 5 away");
  EXPECT_EQ(DescribeMatcher<Vec2>(IsNear(Vec2(1, 0.25), 0.5)), "is at most 0.5 away from (1, 0.25)");
  EXPECT_EQ(DescribeMatcher<Vec2>(Not(IsNear(Vec2(1, 2), 0.5))), "is more than 0.5 away from (1, 2)");
}

TEST(IsSameFrameMatcher, SaysWhichPixelsDiffer) {
  const Frame white = flatFrame(8, 6, {255, 255, 255, 255});
  EXPECT_THAT(white, IsSameFrame(white));
  EXPECT_THAT(specked(3, 4), Not(IsSameFrame(white)));
  EXPECT_THAT(explained(IsSameFrame(white), specked(3, 4)),
              AllOf(StartsWith("\ndiffers\n"), HasSubstr("1 px differ, 0 allowed"),
                    HasSubstr("differing pixels"), HasSubstr("3, 4: (255, 255, 255), (0, 255, 255)\n")));
  Tolerance one;
  one.maxPixels = 1;
  EXPECT_THAT(specked(3, 4), IsSameFrame(white, one));
  EXPECT_THAT(explained(IsSameFrame(white), flatFrame(8, 7, {255, 255, 255, 255})),
              HasSubstr("size differs"));
  EXPECT_EQ(::testing::PrintToString(white), "a frame of 8x6 px");
}

class MatchesGoldenMatcher : public ::testing::Test {
protected:
  MatchesGoldenMatcher() {
    setGoldenFolder(dir_ / "goldens");
    setGoldenOutFolder(dir_ / "out");
    std::filesystem::create_directory(dir_ / "goldens");
  }
  ~MatchesGoldenMatcher() override {
    setGoldenFolder("");
    setGoldenOutFolder("");
  }
  TempDir dir_;
};

TEST_F(MatchesGoldenMatcher, SaysWhereTheFilesAre) {
  std::filesystem::copy_file(OFFSTAGE_SOURCE_DIR "/tests/goldens/fall@4s.png", dir_ / "goldens/fall.png");
  const Frame right = sceneFrame(OFFSTAGE_SOURCE_DIR "/scenes/fall.toml", 4.0);
  EXPECT_THAT(right, MatchesGolden("fall"));
  EXPECT_EQ(dir_.names(), (std::vector<std::string>{"goldens"})); // nothing is left when it holds

  Frame wrong = right;
  wrong.rgba[4 * pixelIndex(10, wrong.width, 20)] = 7;
  EXPECT_THAT(explained(MatchesGolden("fall"), wrong),
              AllOf(HasSubstr("differs\n"), HasSubstr("20, 10: (255, 255, 255), (7, 255, 255)\n"),
                    HasSubstr(fmt::format("  golden: {}\n", (dir_ / "goldens/fall.png").string())),
                    HasSubstr(fmt::format("  drawn:  {}\n", (dir_ / "out/fall.actual.png").string())),
                    HasSubstr(fmt::format("  strip:  {}\n", (dir_ / "out/fall.strip.png").string())),
                    HasSubstr("OFFSTAGE_UPDATE_GOLDENS=1 takes what was drawn\n")));
  EXPECT_EQ(loadImage(dir_ / "out/fall.actual.png").rgba, wrong.rgba);
  EXPECT_EQ(loadImage(dir_ / "goldens/fall.png").rgba, right.rgba);
}

TEST_F(MatchesGoldenMatcher, SaysThatAGoldenIsMissingOrBroken) {
  const Frame frame = specked(1, 1);
  EXPECT_EQ(explained(MatchesGolden("none"), frame),
            fmt::format("\ngolden missing: {}\n  drawn: {}\n  OFFSTAGE_UPDATE_GOLDENS=1 records it\n",
                        (dir_ / "goldens/none.png").string(), (dir_ / "out/none.actual.png").string()));
  dir_.write("goldens/broken.png", "no picture");
  EXPECT_THAT(frame, Not(MatchesGolden("broken")));
  EXPECT_THAT(explained(MatchesGolden("broken"), frame), HasSubstr("broken.png"));
  EXPECT_EQ(explained(MatchesGolden("../elsewhere"), frame),
            "\n\"../elsewhere\" cannot be a golden's name\n");
}

/// The part of the tests below that runs in a process of its own, in the folder that the parent names.
TEST(MatchesGoldenInChild, HoldsTwoFramesToTheirGoldens) {
  if (std::getenv("OFFSTAGE_GOLDENS") == nullptr) GTEST_SKIP() << "runs as a child of the tests below";
  EXPECT_THAT(specked(1, 1), MatchesGolden("one"));
  EXPECT_THAT(specked(2, 2), MatchesGolden("two"));
}

TEST(UpdatingGoldens, RewritesThemAndFailsWithAList) {
  const TempDir dir;
  const std::string goldens = dir.path().string();
  ChildEnvironment environment{
      {"OFFSTAGE_GOLDENS", goldens}, {"OFFSTAGE_GOLDEN_OUT", dir / "out"}, {"OFFSTAGE_UPDATE_GOLDENS", "1"}};
  const auto run = [&] { return runTestInChild("MatchesGoldenInChild.*", environment); };
  const ChildResult recorded = run();
  EXPECT_EQ(recorded.exitStatus, 1);
  EXPECT_THAT(recorded.output,
              AllOf(HasSubstr("[       OK ] MatchesGoldenInChild"),
                    HasSubstr(fmt::format("OFFSTAGE_UPDATE_GOLDENS=1 rewrote, so this run does not pass:\n  "
                                          "{0}/one.png\n  {0}/two.png\n",
                                          goldens))));
  EXPECT_THAT(dir.names(), ElementsAre("one.png", "two.png"));
  EXPECT_EQ(run().exitStatus, 0); // they hold now, so nothing is rewritten

  const std::string right = readFile(dir / "one.png");
  dir.write("one.png", readFile(dir / "two.png"));
  const ChildResult again = run();
  EXPECT_EQ(again.exitStatus, 1);
  EXPECT_THAT(again.output, Not(HasSubstr("two.png\n")));
  EXPECT_EQ(readFile(dir / "one.png"), right);

  dir.write("one.png", readFile(dir / "two.png"));
  environment[2].second = std::nullopt;
  EXPECT_EQ(run().exitStatus, 1);
  EXPECT_NE(readFile(dir / "one.png"), right); // without the variable nothing is rewritten
}

TEST(FramesOfExercises, AreThoseOfTheScenes) {
  struct Empty : Exercise {
    [[nodiscard]] Settings settings() const override {
      Settings settings;
      settings.size = {8, 6};
      return settings;
    }
    void start(Stage& /*stage*/) override {}
    void frame(Stage& /*stage*/, double /*dt*/) override {}
  };
  EXPECT_THAT(exerciseFrame<Empty>(0.5), IsSameFrame(flatFrame(8, 6, {255, 255, 255, 255})));
  EXPECT_THROW(static_cast<void>(exerciseFrame<Empty>(1e9)), Error);
  EXPECT_THROW(static_cast<void>(sceneFrame("/nowhere.toml", 0.0)), Error);
}

} // namespace
} // namespace offstage::test
