#include "src/scene/diagnostic.h"
#include "src/scene/dt_log.h"
#include "tests/support/scene_text.h"
#include "tests/support/temp_dir.h"

#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

using ::testing::ElementsAre;
using Durations = std::vector<std::int64_t>;

std::vector<std::string> errorsOfLog(std::string_view text) {
  std::vector<std::string> errors;
  try {
    static_cast<void>(parseDtLog(text, "a.dt"));
  } catch (const SceneError& problems) {
    for (const Diagnostic& diagnostic : problems.diagnostics()) errors.push_back(diagnostic.text());
  }
  return errors;
}

TEST(DtLog, OneDurationALine) {
  EXPECT_EQ(parseDtLog("16666667\n16666666\n", "a.dt"), (Durations{16666667, 16666666}));
}

TEST(DtLog, CommentsEmptyLinesBlanksAndWindowsLineEndsAreSkipped) {
  EXPECT_EQ(parseDtLog("\xEF\xBB\xBF# recorded\r\n\r\n  5\t\r\n#6\n\n7", "a.dt"), (Durations{5, 7}));
}

TEST(DtLog, AFrameMayTakeNoTime) {
  EXPECT_EQ(parseDtLog("0\n0\n", "a.dt"), (Durations{0, 0}));
}

TEST(DtLog, TimestampsBecomeTheirDifferences) {
  EXPECT_EQ(parseDtLog("# now\n1000\n1016\n1016\n1050\n", "a.dt"), (Durations{16, 0, 34}));
  EXPECT_EQ(parseDtLog("  #   now  \r\n7\n9\n", "a.dt"), (Durations{2}));
  EXPECT_EQ(parseDtLog("# now\n9223372036854775000\n9223372036854775807\n", "a.dt"), (Durations{807}));
}

TEST(DtLog, NowCountsInTheFirstLineOnly) {
  EXPECT_EQ(parseDtLog("# a recording\n# now\n10\n20\n", "a.dt"), (Durations{10, 20}));
  EXPECT_EQ(parseDtLog("# nowadays\n10\n20\n", "a.dt"), (Durations{10, 20}));
}

TEST(DtLog, EveryWrongLineIsReportedWhereItStands) {
  EXPECT_THAT(errorsOfLog("16.67\n5\n  x1\n-3\n99999999999999999999\n1 2\n+4\n"),
              ElementsAre("a.dt:1:1: error: \"16.67\" is not a whole number of nanoseconds",
                          "a.dt:3:3: error: \"x1\" is not a whole number of nanoseconds",
                          "a.dt:4:1: error: a frame's duration must be at least 0 ns, but it is -3",
                          "a.dt:5:1: error: \"99999999999999999999\" is more than 64 bits hold",
                          "a.dt:6:1: error: \"1 2\" is not a whole number of nanoseconds",
                          "a.dt:7:1: error: \"+4\" is not a whole number of nanoseconds"));
}

TEST(DtLog, TimestampsMustNotGoBack) {
  EXPECT_THAT(errorsOfLog("# now\n10\n9\n-1\n12\n"),
              ElementsAre("a.dt:3:1: error: timestamps must not go back, but 9 comes after 10",
                          "a.dt:4:1: error: a timestamp must be at least 0, but it is -1"));
}

TEST(DtLog, ALogWithoutFramesIsAnError) {
  EXPECT_THAT(errorsOfLog(""),
              ElementsAre("a.dt: error: the log holds no frame; it needs at least one duration in "
                          "nanoseconds"));
  EXPECT_THAT(errorsOfLog("# now\n5\n"),
              ElementsAre("a.dt: error: the log holds no frame; it needs at least two timestamps"));
}

TEST(DtLog, TimestampsWithoutTheirFirstLineAreTooLong) {
  EXPECT_THAT(
      errorsOfLog("81234567890123\n81234584556790\n"),
      ElementsAre("a.dt:2:1: error: a log may last at most 86400 s in all; a log of raw timestamps needs the "
                  "first line '# now'"));
  EXPECT_THAT(errorsOfLog("# now\n0\n86400000000000\n86400000000001\n"),
              ElementsAre("a.dt:4:1: error: a log may last at most 86400 s in all"));
}

TEST(DtLog, BinaryAndEndlessInputEndsWithAnError) {
  EXPECT_THAT(errorsOfLog(std::string_view("\0\x1b[31m", 6)),
              ElementsAre("a.dt:1:1: error: \"\\x00\\x1b[31m\" is not a whole number of nanoseconds"));
  std::string many;
  for (int line = 0; line < 5000; ++line) many += "x\n";
  EXPECT_EQ(errorsOfLog(many).size(), 1000U);
}

TEST(DtLog, FilesAreRead) {
  const test::TempDir folder;
  EXPECT_EQ(readDtLog(folder.write("a.dt", "1\n2\n")), (Durations{1, 2}));
  EXPECT_EQ(readDtLog(OFFSTAGE_SOURCE_DIR "/tests/reference/trajectories/dt/dt60.txt").front(), 16666667);
  for (const auto& missing : {folder.path() / "none.dt", folder.path()}) {
    try {
      static_cast<void>(readDtLog(missing));
      ADD_FAILURE() << missing << " was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::BadInput);
      EXPECT_TRUE(std::string(error.what()).starts_with(missing.string() + ": error: ")) << error.what();
    }
  }
}

} // namespace
} // namespace offstage
