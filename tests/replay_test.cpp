#include "render/job/scene_source.h"
#include "src/scene/replay.h"
#include "src/scene/scene.h"
#include "tests/support/process.h"
#include "tests/support/scene_text.h"
#include "tests/support/temp_dir.h"

#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kHeader = "frame,time,id,x,y,radius,group\n";

class Replaying : public ::testing::Test {
protected:
  /// A scene that replays these rows.
  [[nodiscard]] Scene replayOf(const std::string& rows, const std::string& keys = "",
                               const SceneOverrides& overrides = {}) const {
    folder_.write("student.csv", kHeader + rows);
    return parseScene("[replay]\ntrace = \"student.csv\"\n" + keys, folder_ / "scene.toml", overrides);
  }

  /// What is wrong with it, without the folder's name.
  [[nodiscard]] std::vector<std::string> problemsOf(const std::string& rows, const std::string& keys = "",
                                                    const SceneOverrides& overrides = {}) const {
    std::vector<std::string> errors;
    try {
      static_cast<void>(replayOf(rows, keys, overrides));
    } catch (const SceneError& problems) {
      for (const Diagnostic& diagnostic : problems.diagnostics())
        errors.push_back(diagnostic.text().substr(folder_.path().string().size() + 1));
    }
    return errors;
  }

  TempDir folder_;
};

std::vector<double> timesOf(const Scene& scene) {
  std::vector<double> times;
  for (const Replay::Frame& frame : scene.replay->frames) times.push_back(frame.time);
  return times;
}

std::vector<std::size_t> countsOf(const Scene& scene) {
  std::vector<std::size_t> counts;
  for (const Replay::Frame& frame : scene.replay->frames) counts.push_back(frame.count);
  return counts;
}

TEST_F(Replaying, AnEvenTraceHasItsFrameRate) {
  std::string rows;
  for (int frame = 0; frame <= 60; ++frame) rows += fmt::format("{},{},0,1,2,3,a\n", frame, frame / 60.0);
  const Scene scene = replayOf(rows);
  EXPECT_TRUE(scene.clock.isFixed());
  EXPECT_EQ(scene.clock.fps(), 60.0);
  EXPECT_EQ(scene.clock.steps(), 60);
  SceneOverrides slower;
  slower.fps = 24.0;
  EXPECT_FALSE(replayOf(rows, "", slower).clock.isFixed()); // so that render resamples it
  SceneOverrides shorter;
  shorter.duration = 0.5;
  EXPECT_EQ(replayOf(rows, "", shorter).clock.steps(), 30);
}

TEST_F(Replaying, AnUnevenTraceKeepsItsTimes) {
  const Scene scene = replayOf("5,100,0,1,2,3,a\n6,100.25,0,1,2,3,a\n7,101,0,1,2,3,a\n");
  EXPECT_FALSE(scene.clock.isFixed());
  EXPECT_EQ(scene.clock.nanoseconds(1), 250'000'000);
  EXPECT_EQ(scene.clock.nanoseconds(2), 1'000'000'000);
}

TEST_F(Replaying, StartsWhereItIsTold) {
  const std::string rows = "10,1,0,1,2,3,a\n11,2,0,1,2,3,a\n12,3,0,1,2,3,a\n";
  const Scene early = replayOf(rows, "start = 0\n");
  EXPECT_THAT(timesOf(early), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(countsOf(early), ElementsAre(0, 1, 1, 1)); // nothing is there yet
  EXPECT_THAT(timesOf(replayOf(rows)), ElementsAre(0, 1, 2));
  EXPECT_THAT(timesOf(replayOf(rows, "start = 1.5\n")), ElementsAre(0, 0.5, 1.5));
  EXPECT_THAT(timesOf(replayOf(rows, "start = 3\n")), ElementsAre(0));
}

TEST_F(Replaying, WhereFramesAreMissingNobodyWasThere) {
  const Scene scene = replayOf("0,0,0,1,2,3,a\n1,0.5,0,1,2,3,a\n5,2.5,1,1,2,3,a\n");
  EXPECT_THAT(timesOf(scene), ElementsAre(0, 0.5, 1, 2.5));
  EXPECT_THAT(countsOf(scene), ElementsAre(1, 1, 0, 1));
  const Scene everyTenth = replayOf("0,0,0,1,2,3,a\n10,0.5,0,1,2,3,a\n20,1,0,1,2,3,a\n");
  EXPECT_THAT(countsOf(everyTenth), ElementsAre(1, 1, 1));
}

TEST_F(Replaying, LooksGoByIdThenByGroupThenByTurns) {
  const Scene scene = replayOf("0,0,0,1,2,3,a\n0,0,1,1,2,3,a\n0,0,2,1,2,3,b\n0,0,3,1,2,3,b\n0,0,4,1,2,3,c\n"
                               "1,1,3,1,2,3,b\n1,1,5,1,2,3,c\n",
                               "fill = { cycle = [\"red\", \"lime\"] }\n"
                               "[[replay.look]]\nid = 0\nfill = \"blue\"\n"
                               "[[replay.look]]\ngroup = \"b\"\nfill = { cycle = [\"#111\", \"#222\"] }\n");
  std::vector<int> reds;
  for (const std::uint32_t look : scene.replay->looks)
    reds.push_back(std::get<Color>(*scene.looks.at(look).fill).red);
  EXPECT_THAT(reds, ElementsAre(0, 255, 0x11, 0x22, 0, 0x22, 255));
}

TEST_F(Replaying, TheMotionHasTheTracesBodies) {
  const Scene scene = replayOf("0,0,7,1,2,3,a\n1,0.5,7,4,5,6,a\n");
  SceneSource source(scene, Viewport::scaled(640, 480, 1.0));
  source.step();
  ASSERT_EQ(source.bodies().size(), 1U);
  EXPECT_EQ(source.bodies()[0].id, 7U);
  EXPECT_EQ(source.bodies()[0].position, Vec2(4, 5));
  EXPECT_EQ(source.bodies()[0].radius, 6.0);
  EXPECT_EQ(source.time(), 0.5);
}

TEST_F(Replaying, TellsWhatCannotBe) {
  const std::string row = "0,0,0,1,2,3,balls\n";
  EXPECT_THAT(problemsOf(""),
              ElementsAre("scene.toml:2:9: error: 'trace' in [replay] names a trace without rows, so "
                          "there is nothing to show"));
  EXPECT_THAT(problemsOf(row, "start = 1\n"),
              ElementsAre("scene.toml:3:9: error: 'start' in [replay] is 1 s, but the trace ends at 0 s"));
  EXPECT_THAT(
      problemsOf("0,0,-1,1,2,3,a\n"),
      ElementsAre(
          "student.csv:2:1: error: the ids of a replay are from 0 to 4294967295, but here one is -1"));
  EXPECT_THAT(problemsOf("0,0,x,1,2,3,a\n"),
              ElementsAre("student.csv:2:5: error: 'id' must be a whole number, but it is \"x\""));
  EXPECT_THAT(problemsOf("0,0,0,1,2,3,a\n1,1e6,0,1,2,3,a\n"),
              ElementsAre("scene.toml:2:9: error: 'trace' in [replay] gives a replay of more than 86400 s"));
  EXPECT_THAT(
      problemsOf(row, "[[replay.look]]\nid = 1\n[[replay.look]]\ngroup = \"ball\"\n[[replay.look]]\n"
                      "[[replay.look]]\nid = 0\ngroup = \"balls\"\n"),
      ElementsAre(
          "scene.toml:4:6: error: 'id' in [[replay.look]] is 1, a body that the trace does not have",
          "scene.toml:6:9: error: 'group' in [[replay.look]] names \"ball\", a group that the trace "
          "does not have; did you mean \"balls\"?",
          "scene.toml:7:1: error: [[replay.look]] needs 'id' or 'group'",
          "scene.toml:9:6: error: 'id' in [[replay.look]] cannot stand beside 'group': give one of the two"));
  EXPECT_THAT(problemsOf(row, "[[replay.look]]\nid = 0\n[[replay.look]]\nid = 0\n"),
              ElementsAre("scene.toml:6:6: error: 'id' in [[replay.look]] is 0, which has a look already"));
  EXPECT_THAT(problemsOf(row, "[[replay.look]]\nid = 0\nfill = { cycle = [\"red\"] }\n"),
              ElementsAre(HasSubstr("belongs where there are many bodies")));
}

TEST_F(Replaying, NothingThatMovesStandsBesideIt) {
  EXPECT_THAT(
      problemsOf("0,0,0,1,2,3,a\n", "[world]\n[clock]\nfps = 30\n[[body]]\ncenter = [1, 2]\nradius = 3\n"),
      ElementsAre("scene.toml:3:1: error: 'world' cannot stand beside [replay], which simulates nothing",
                  "scene.toml:4:1: error: 'clock' cannot stand beside [replay], whose trace has the times",
                  "scene.toml:6:1: error: 'body' cannot stand beside [replay], which simulates nothing"));
  SceneOverrides log;
  log.dtLog = folder_.write("x.dt", "1\n");
  EXPECT_THAT(
      problemsOf("0,0,0,1,2,3,a\n", "", log),
      ElementsAre("scene.toml: error: a dt log cannot be given for a replay, whose trace has the times"));
}

TEST(ReplayCommand, ATracedSceneIsReplayedToTheSameStatesAndPixels) {
  const TempDir dir;
  ASSERT_EQ(offstage({"trace", scene("exercise1_bounce"), "-o", dir / "x.csv"}).status, 0);
  ASSERT_EQ(offstage({"render", scene("exercise1_bounce"), "--hash", dir / "original.txt"}).status, 0);
  dir.write("replay.toml", "[replay]\ntrace = \"x.csv\"\n");
  const ProcessResult result = offstage({"render", dir / "replay.toml", "--hash", dir / "replayed.txt"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(readFile(dir / "replayed.txt"), readFile(dir / "original.txt"));
}

TEST(ReplayCommand, ItsTraceIsNotTracedAgain) {
  const TempDir dir;
  dir.write("x.csv", kHeader + "0,0,0,1,2,3,a\n");
  dir.write("replay.toml", "[replay]\ntrace = \"x.csv\"\n");
  const ProcessResult result = offstage({"trace", dir / "replay.toml", "-o", dir / "y.csv"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("simulates nothing: it replays the trace"));
  EXPECT_EQ(dir.names().size(), 2U);
}

} // namespace
} // namespace offstage::test
