#include "src/scene/scene.h"
#include "tests/support/scene_text.h"
#include "tests/support/temp_dir.h"

#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

using test::errorsOf;
using test::sceneOf;
using ::testing::ElementsAre;

constexpr const char* kLog = "10000000\n20000000\n30000000\n40000000\n"; // frames at 10, 30, 60 and 100 ms

TEST(Override, FpsAndDurationReplaceThoseOfTheScene) {
  SceneOverrides overrides;
  overrides.fps = 25.0;
  overrides.duration = 3.0;
  const Scene scene = sceneOf("duration = 20\n[clock]\nfps = 60\n", overrides);
  EXPECT_TRUE(scene.clock.isFixed());
  EXPECT_EQ(scene.clock.fps(), 25.0);
  EXPECT_EQ(scene.clock.steps(), 75);
}

TEST(Override, SeedAndScaleReplaceThoseOfTheScene) {
  SceneOverrides overrides;
  overrides.seed = std::numeric_limits<std::int64_t>::min();
  overrides.scale = 0.5;
  const Scene scene = sceneOf("seed = 3\n[frame]\nscale = 2.0\n", overrides);
  EXPECT_EQ(scene.world.seed, std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(scene.scale, 0.5);
}

TEST(Override, DtLogReplacesFpsAndItsPathIsNotRelativeToTheScene) {
  const test::TempDir folder;
  SceneOverrides overrides;
  overrides.dtLog = folder.write("run.dt", kLog);
  const Scene scene = sceneOf("[clock]\nfps = 60\n", overrides);
  EXPECT_FALSE(scene.clock.isFixed());
  EXPECT_EQ(scene.clock.steps(), 4);
  EXPECT_EQ(scene.clock.time(2), 0.03);
}

TEST(Override, DtLogReplacesTheScenesRecordingWhichNeedNotBeThere) {
  const test::TempDir folder;
  SceneOverrides overrides;
  overrides.dtLog = folder.write("run.dt", kLog);
  EXPECT_EQ(sceneOf("[clock]\nrecorded = \"not there.dt\"\n", overrides).clock.steps(), 4);
}

TEST(Override, DurationCutsARecordedClockAsTheScenesOwnDoes) {
  const test::TempDir folder;
  folder.write("run.dt", kLog);
  SceneOverrides overrides;
  overrides.duration = 0.06;
  const Scene cut = parseScene("[clock]\nrecorded = \"run.dt\"\n", folder.path() / "a.toml", overrides);
  EXPECT_EQ(cut.clock.steps(), 3) << "the frame at exactly 60 ms belongs to it";
  EXPECT_EQ(parseScene("duration = 0.0599\n[clock]\nrecorded = \"run.dt\"\n", folder.path() / "a.toml")
                .clock.steps(),
            2);
}

TEST(Override, FpsIsOfNoEffectOnARecordedClock) {
  const test::TempDir folder;
  folder.write("run.dt", kLog);
  SceneOverrides overrides;
  overrides.fps = 25.0;
  const Scene scene = parseScene("[clock]\nrecorded = \"run.dt\"\n", folder.path() / "a.toml", overrides);
  EXPECT_FALSE(scene.clock.isFixed());
  EXPECT_EQ(scene.clock.steps(), 4);
}

TEST(Override, ValuesOutOfRangeAreErrorsOfTheRun) {
  SceneOverrides overrides;
  overrides.fps = 0.0;
  overrides.duration = std::numeric_limits<double>::quiet_NaN();
  overrides.scale = 1000.0;
  EXPECT_THAT(
      errorsOf("titel = 1\n", overrides),
      ElementsAre(
          "scene.toml: error: the scale given for this run must be greater than 0 and at most 64, but "
          "it is 1000",
          "scene.toml: error: the fps given for this run must be greater than 0 and at most 1000000, "
          "but it is 0",
          "scene.toml: error: the duration given for this run must be from 0 to 86400, but it is nan",
          "scene.toml:1:1: error: unknown key 'titel'; did you mean 'title'?"));
}

TEST(Override, AScaleThatMakesThePictureTooLargeOrEmptyIsAnError) {
  SceneOverrides overrides;
  overrides.scale = 64.0;
  EXPECT_THAT(errorsOf("", overrides),
              ElementsAre("scene.toml: error: size times scale gives a picture of 40960x30720 "
                          "px; each side must be from 1 to 16384"));
  overrides.scale = 0.0001;
  EXPECT_THAT(errorsOf("", overrides),
              ElementsAre("scene.toml: error: size times scale gives a picture of 0x0 px; "
                          "each side must be from 1 to 16384"));
}

TEST(Override, AMissingDtLogIsNamed) {
  SceneOverrides overrides;
  overrides.dtLog = "no such folder/run.dt";
  EXPECT_THAT(errorsOf("", overrides),
              ElementsAre("no such folder/run.dt: error: cannot be read: No such file or directory"));
}

} // namespace
} // namespace offstage
