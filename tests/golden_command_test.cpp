#include "tests/support/golden_folder.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(GoldenCommand, WhatWasRecordedIsTheSame) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  const ProcessResult recorded = folder.golden({"record", "."});
  EXPECT_EQ(recorded.status, 0) << recorded.err;
  EXPECT_THAT(recorded.out, AllOf(HasSubstr("recorded fall@0s\n"), HasSubstr("recorded fall@0.5s\n"),
                                  HasSubstr("2 recorded, 0 unchanged, 0 differ\n")));
  EXPECT_THAT(folder.dir().names(),
              ElementsAre("fall.states.csv", "fall.toml", "fall@0.5s.png", "fall@0s.png", "goldens.lock"));
  const ProcessResult verified = folder.golden({"verify", "."});
  EXPECT_EQ(verified.status, 0) << verified.out << verified.err;
  // Recording again changes nothing, to the byte.
  const std::string lock = readFile(folder.dir() / "goldens.lock");
  EXPECT_EQ(folder.golden({"record", "."}).status, 0);
  EXPECT_EQ(readFile(folder.dir() / "goldens.lock"), lock);
}

TEST(GoldenCommand, AnotherColourChangesPixelsButNotPhysics) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  folder.writeScene("fall", "blue", 40);
  const ProcessResult verified = folder.golden({"verify", "."});
  EXPECT_EQ(verified.status, 1);
  EXPECT_THAT(verified.out, AllOf(HasSubstr("fall@0.5s: pixels changed, physics did not\n"),
                                  Not(HasSubstr("physics changed\n"))));
  EXPECT_THAT(folder.dir().names("out/golden"),
              ElementsAre("drawn.lock", "fall.states.csv", "fall@0.5s.actual.png", "fall@0.5s.strip.png",
                          "fall@0s.actual.png", "fall@0s.strip.png", "report", "verified.txt"));
  EXPECT_TRUE(std::filesystem::exists(folder.dir() / "out/golden/report/index.html"));
}

TEST(GoldenCommand, AnotherGravityIsAnotherPhysicsInItsFirstFrameAndBody) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  folder.writeScene("fall", "red", 46);
  const ProcessResult verified = folder.golden({"verify", "."});
  EXPECT_EQ(verified.status, 1);
  EXPECT_THAT(verified.out,
              AllOf(HasSubstr("fall@0.5s: physics changed\n"), Not(HasSubstr("fall@0s")),
                    HasSubstr("  first frame that differs: 1\n"),
                    // 46/3600 px instead of 40/3600
                    HasSubstr("  frame 1 (0.0166667 s), body 0: y is 10.012777777777778, expected "
                              "10.011111111111111 (off by 0.00166667 px); body 0 is \"ball\"\n")));
}

TEST(GoldenCommand, AnotherBounceIsFoundInTheFrameOfTheBounce) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 400, "at = [1]");
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  std::string scene = readFile(folder.dir() / "fall.toml");
  scene.replace(scene.find("bottom = 0.5"), 12, "bottom = 0.6");
  folder.dir().write("fall.toml", scene);
  const ProcessResult verified = folder.golden({"verify", "."});
  EXPECT_EQ(verified.status, 1);
  // 32 px at 400 px/s² take 0.4 s: y = g·dt²·n(n + 1)/2 reaches them in step 24.
  EXPECT_THAT(verified.out,
              AllOf(HasSubstr("  first frame that differs: 24\n"), HasSubstr("body 0: vy is ")));
}

TEST(GoldenCommand, TellsSizeMissingAndObsolete) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  folder.writeScene("other", "red", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  std::string scene = readFile(folder.dir() / "fall.toml");
  scene.replace(scene.find("[64, 48]"), 8, "[65, 48]");
  folder.dir().write("fall.toml", scene);
  std::filesystem::remove(folder.dir() / "other@0s.png");
  folder.writeScene("other", "red", 40, "at = [0]");
  const ProcessResult verified = folder.golden({"verify", "."});
  EXPECT_EQ(verified.status, 1);
  EXPECT_THAT(verified.out,
              AllOf(HasSubstr("fall@0s: size changed\n"), HasSubstr("other@0s: golden missing\n"),
                    HasSubstr("other@0.5s: golden obsolete\n")));
}

TEST(GoldenCommand, RecordLeavesAGoldenThatDiffers) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  const std::string before = readFile(folder.dir() / "fall@0s.png");
  const std::string states = readFile(folder.dir() / "fall.states.csv");
  folder.writeScene("fall", "blue", 50, "at = [0, 0.25, 0.5]");
  const ProcessResult recorded = folder.golden({"record", "."});
  EXPECT_EQ(recorded.status, 1);
  EXPECT_THAT(recorded.out, HasSubstr("1 recorded, 0 unchanged, 2 differ\n"));
  EXPECT_EQ(readFile(folder.dir() / "fall@0s.png"), before);
  EXPECT_EQ(readFile(folder.dir() / "fall.states.csv"), states);
}

TEST(GoldenCommand, APictureWithoutALineIsComparedAndNeverReplacedByRecord) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40, "at = [0]");
  folder.writeScene("other", "red", 40, "at = [0]");
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  folder.writeScene("fall", "blue", 40, "at = [0]");
  std::filesystem::remove(folder.dir() / "goldens.lock");
  const std::string red = readFile(folder.dir() / "fall@0s.png");
  const ProcessResult verified = folder.golden({"verify", "."});
  EXPECT_EQ(verified.status, 1);
  EXPECT_THAT(verified.out,
              AllOf(HasSubstr("fall@0s: golden missing\n"), HasSubstr("132 px differ"),
                    HasSubstr("other@0s: golden missing\n"), HasSubstr("goldens.lock has no line for it")));
  const ProcessResult recorded = folder.golden({"record", "."});
  EXPECT_EQ(recorded.status, 1);
  EXPECT_THAT(recorded.out, HasSubstr("1 recorded, 0 unchanged, 1 differ\n"));
  EXPECT_EQ(readFile(folder.dir() / "fall@0s.png"), red);
}

TEST(GoldenCommand, AcceptTakesTheChosenOnesAsTheyWereSeen) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  EXPECT_EQ(folder.golden({"accept", "."}).status, 2); // nothing was looked at yet
  folder.writeScene("fall", "blue", 40, "at = [0.5, 1]");
  ASSERT_EQ(folder.golden({"verify", "."}).status, 1);

  const ProcessResult unknown = folder.golden({"accept", ".", "fall@0.6s"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err,
              HasSubstr("\"fall@0.6s\" is not among what the last verification left; did you mean "
                        "\"fall@0.5s\"?"));

  const ProcessResult one = folder.golden({"accept", ".", "fall@0.5s"});
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_THAT(one.out, HasSubstr("accepted fall@0.5s\n1 accepted"));
  EXPECT_EQ(readFile(folder.dir() / "fall@0.5s.png"),
            readFile(folder.dir() / "out/golden/fall@0.5s.actual.png"));

  ASSERT_EQ(folder.golden({"verify", "."}).status, 1); // the others
  EXPECT_EQ(folder.golden({"accept", "."}).status, 0);
  EXPECT_EQ(folder.golden({"verify", "."}).status, 0);
  EXPECT_THAT(folder.dir().names(), Not(Contains("fall@0s.png"))); // obsolete
}

TEST(GoldenCommand, AcceptRefusesWhatItIsNotSureOf) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  ASSERT_EQ(folder.golden({"verify", "."}).status, 1);
  // Another picture than the one that was drawn.
  std::filesystem::copy_file(folder.dir() / "out/golden/fall@0s.actual.png",
                             folder.dir() / "out/golden/fall@0.5s.actual.png",
                             std::filesystem::copy_options::overwrite_existing);
  const ProcessResult changed = folder.golden({"accept", ".", "fall@0.5s"});
  EXPECT_EQ(changed.status, 2);
  EXPECT_THAT(changed.err, HasSubstr("is not the picture that the last verification drew"));
  EXPECT_THAT(folder.dir().names(), Not(Contains("fall@0.5s.png")));
  // Another folder than the one that was verified.
  std::filesystem::create_directory(folder.dir() / "elsewhere");
  const ProcessResult elsewhere = folder.golden({"accept", "elsewhere"});
  EXPECT_EQ(elsewhere.status, 2);
  EXPECT_THAT(elsewhere.err, HasSubstr("verify first"));
}

TEST(GoldenCommand, ToleranceComesFromTheFolderOrTheScene) {
  const GoldenFolder folder;
  folder.writeScene("fall", "#ff0000", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  folder.writeScene("fall", "#fd0000", 40);
  EXPECT_EQ(folder.golden({"verify", "."}).status, 1);
  folder.dir().write("tolerance.toml", "max_channel = 2\n");
  EXPECT_EQ(folder.golden({"verify", "."}).status, 0);
  folder.writeScene("fall", "#fd0000", 40, "at = [0, 0.5]\nmax_channel = 1");
  EXPECT_EQ(folder.golden({"verify", "."}).status, 1);
  folder.writeScene("fall", "#fd0000", 40, "at = [0, 0.5]\nmax_channel = 2");
  std::filesystem::remove(folder.dir() / "tolerance.toml");
  EXPECT_EQ(folder.golden({"verify", "."}).status, 0);
}

TEST(GoldenCommand, BadInputIsRefused) {
  const GoldenFolder folder;
  EXPECT_EQ(folder.golden({}).status, 2);
  EXPECT_EQ(folder.golden({"verify"}).status, 2);
  EXPECT_EQ(folder.golden({"verify", "nowhere"}).status, 2);
  const ProcessResult none = folder.golden({"record", "."});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("no scene in . has a [golden]"));
  folder.writeScene("fall", "red", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  folder.dir().write("fall@0s.png", "no picture");
  EXPECT_EQ(folder.golden({"verify", "."}).status, 2);
  EXPECT_EQ(folder.golden({"verify", ".", "--out", "."}).status, 2);
}

TEST(GoldenCommand, ReportsAsJsonAndJunit) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  folder.writeScene("fall", "red", 46);
  const ProcessResult verified = folder.golden({"verify", ".", "--json", "--junit", "j.xml"});
  EXPECT_EQ(verified.status, 1);
  EXPECT_THAT(verified.out,
              AllOf(HasSubstr("\"first_differing_frame\": 1"), HasSubstr("\"physics changed\"")));
  EXPECT_THAT(readFile(folder.dir() / "j.xml"),
              AllOf(HasSubstr("offstage.golden"), HasSubstr("fall@0.5s"), HasSubstr("physics changed")));
}

TEST(GoldenCommand, WithoutAVerdictTheJunitFileHoldsTheError) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  ASSERT_EQ(folder.golden({"verify", ".", "--junit", "j.xml"}).status, 0);
  EXPECT_THAT(readFile(folder.dir() / "j.xml"), HasSubstr("errors=\"0\""));
  folder.dir().write("fall@0s.png", "no picture");
  const ProcessResult verified = folder.golden({"verify", ".", "--junit", "j.xml"});
  EXPECT_EQ(verified.status, 2);
  EXPECT_THAT(verified.err, HasSubstr("cannot be read"));
  EXPECT_THAT(readFile(folder.dir() / "j.xml"),
              AllOf(HasSubstr("tests=\"1\" failures=\"0\" errors=\"1\""),
                    HasSubstr("name=\"offstage golden verify .\""), HasSubstr("<error message="),
                    HasSubstr("cannot be read")));
}

TEST(GoldenCommand, AReportReplacesOnlyAReport) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  ASSERT_EQ(folder.golden({"record", "goldens", "--scenes", "."}).status, 0);
  for (const std::string file :
       {"fall.toml", "goldens/fall@0s.png", "goldens/fall.states.csv", "goldens/goldens.lock"}) {
    const std::string before = readFile(folder.dir() / file);
    const ProcessResult verified = folder.golden({"verify", "goldens", "--scenes", ".", "--junit", file});
    EXPECT_EQ(verified.status, 2) << file;
    EXPECT_THAT(verified.err, AllOf(HasSubstr("--junit"), HasSubstr(file)));
    EXPECT_TRUE(readFile(folder.dir() / file) == before) << file << " is not what it was";
  }
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(folder.golden({"verify", "goldens", "--scenes", ".", "--junit", "goldens/j.xml"}).status, 0);
}

TEST(GoldenCommand, SaysTheToleranceThatWasInForce) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40, "at = [0]\nmax_pixels = 200");
  folder.writeScene("other", "red", 40, "at = [0]\nmax_pixels = 200");
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  folder.writeScene("fall", "blue", 40, "at = [0]\nmax_pixels = 200");
  const std::string own = "at most 200 px unequal (./fall.toml)";
  EXPECT_THAT(folder.golden({"verify", "."}).out,
              AllOf(HasSubstr("  tolerance: each scene's own\n"),
                    HasSubstr("  tolerance of 1 of 2: " + own + "\n"),
                    HasSubstr("  tolerance of 1 of 2: at most 200 px unequal (./other.toml)\n")));
  EXPECT_THAT(
      folder.golden({"verify", ".", "--json"}).out,
      AllOf(HasSubstr("\"tolerance\": \"each scene's own\""), HasSubstr("\"tolerance\": \"" + own + "\"")));
  // Beside a scene that is held to the folder's.
  folder.writeScene("other", "red", 40, "at = [0]");
  EXPECT_THAT(folder.golden({"verify", "."}).out,
              AllOf(HasSubstr("  tolerance: no pixel unequal\n"),
                    HasSubstr("  tolerance of 1 of 2: " + own + "\n"), Not(HasSubstr("other.toml"))));
  // One for all needs no more words; a failure names it, too.
  std::filesystem::remove(folder.dir() / "other.toml");
  std::filesystem::remove(folder.dir() / "other@0s.png");
  folder.writeScene("fall", "blue", 40, "at = [0]\nmax_pixels = 20");
  const ProcessResult one = folder.golden({"verify", ".", "--junit", "j.xml"});
  EXPECT_THAT(readFile(folder.dir() / "j.xml"), HasSubstr("tolerance: at most 20 px unequal (./fall.toml)"));
  EXPECT_THAT(one.out, AllOf(HasSubstr("  tolerance: at most 20 px unequal (./fall.toml)\n"),
                             Not(HasSubstr("tolerance of")), Not(HasSubstr("no pixel unequal"))));
}

TEST(GoldenCommand, ScenesMayStandInAnotherFolder) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  EXPECT_EQ(folder.golden({"record", "goldens", "--scenes", "."}).status, 0);
  EXPECT_EQ(folder.golden({"verify", "goldens", "--scenes", "."}).status, 0);
  EXPECT_THAT(folder.dir().names("goldens"), Contains("goldens.lock"));
}

} // namespace
} // namespace offstage::test
