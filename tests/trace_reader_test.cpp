#include "src/scene/diagnostic.h"
#include "src/scene/scene.h"
#include "src/scene/trace.h"
#include "src/scene/trace_reader.h"
#include "tests/support/reference_csv.h"
#include "tests/support/scene_text.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::ElementsAre;

Trace traceOf(const std::string& text) {
  return parseTrace(text, "student.csv");
}

/// Every error of a trace, without the file's name.
std::vector<std::string> traceErrorsOf(const std::string& text) {
  std::vector<std::string> errors;
  try {
    static_cast<void>(traceOf(text));
  } catch (const SceneError& problems) {
    EXPECT_EQ(problems.code(), ExitCode::BadInput);
    const std::string prefix = "student.csv:";
    for (const Diagnostic& diagnostic : problems.diagnostics())
      errors.push_back(diagnostic.text().substr(prefix.size()));
  }
  return errors;
}

TEST(TraceReader, ReadsWhatAnotherProgramWrites) {
  const Trace trace =
      traceOf("frame,time,id,x,y,radius\n0,0.0,0,320.0,60.0,20.0\n1,0.5,0,320.25,1.0E-5,20\n");
  EXPECT_FALSE(trace.hasVelocity);
  EXPECT_THAT(trace.groups, ElementsAre("bodies"));
  ASSERT_EQ(trace.rows.size(), 2U);
  EXPECT_EQ(trace.rows[1].x, 320.25);
  EXPECT_EQ(trace.rows[1].y, 1e-5);
  EXPECT_EQ(trace.rows[1].line, 3U);
  ASSERT_EQ(trace.frames.size(), 2U);
  EXPECT_EQ(trace.frames[1].time, 0.5);
}

TEST(TraceReader, ReadsBackWhatTheWriterWroteToTheLastBit) {
  Scene scene = sceneOf(
      "[[body]]\ngroup = \"a,\\\"b\\\"\\n#\"\ncenter = [0.1, 2.5]\nradius = 3\nvelocity = [-4, 1e300]\n"
      "[[body]]\ncenter = [0, 0]\nradius = 5e-9\n");
  scene.world.bodies[1].position = {std::numeric_limits<double>::quiet_NaN(),
                                    -std::numeric_limits<double>::infinity()};
  std::ostringstream out;
  TraceWriter(out, TraceFormat::Csv, scene.world.groups).write(World(scene.world));
  const Trace trace = traceOf(out.str());
  ASSERT_EQ(trace.rows.size(), 2U);
  EXPECT_EQ(trace.groups.at(trace.rows[0].group), "a,\"b\"\n#");
  EXPECT_EQ(trace.rows[0].x, 0.1);
  EXPECT_EQ(trace.rows[0].vy, 1e300);
  EXPECT_TRUE(std::isnan(trace.rows[1].x));
  EXPECT_EQ(trace.rows[1].y, -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(trace.hasVelocity);
}

TEST(TraceReader, ReadsJsonLinesAsTheWriterWritesThem) {
  Scene scene = sceneOf("[[body]]\ngroup = \"a,\\\"b\\\"\\n\\u00e4\"\ncenter = [0.1, 2.5]\nradius = "
                        "3\nvelocity = [-4, 1e300]\n");
  scene.world.bodies[0].position.y() = std::numeric_limits<double>::infinity();
  std::ostringstream out;
  TraceWriter(out, TraceFormat::JsonLines, scene.world.groups).write(World(scene.world));
  const Trace trace = traceOf(out.str());
  ASSERT_EQ(trace.rows.size(), 1U);
  EXPECT_EQ(trace.groups.front(), "a,\"b\"\nä");
  EXPECT_EQ(trace.rows[0].x, 0.1);
  EXPECT_TRUE(std::isnan(trace.rows[0].y)); // JSON has no infinity, so it was written as null
  EXPECT_EQ(trace.rows[0].vy, 1e300);
  EXPECT_TRUE(trace.hasVelocity);
  const Trace foreign = traceOf(
      "\n {\"id\": 7, \"x\":1,\"y\" :2, \"radius\":3,\"time\":0.5,\"frame\":0,\"note\":\"\\ud83d\\ude00\","
      "\"group\":\"\\u00e4\\ud83d\\ude00\"}\r\n");
  EXPECT_EQ(foreign.groups.front(), "ä😀");
  EXPECT_FALSE(foreign.hasVelocity);
}

TEST(TraceReader, TellsWhatIsWrongWithJsonLines) {
  const std::string start = "{\"frame\":0,\"time\":0,\"id\":0,\"x\":1,\"y\":2";
  EXPECT_THAT(traceErrorsOf(start + "}\n" + start + ",\"radius\":\"a\"}\n" + start + ",\"radius\":[1]}\n" +
                            start + ",\"radius\":1} x\n" + start + ",\"radius\":1,\"x\":1}\n" + start),
              ElementsAre("1:1: error: this line has no 'radius'",
                          "2:49: error: 'radius' must be a number, but it is \"a\"",
                          "3:49: error: here this line stops being a JSON object of numbers and texts",
                          "4:52: error: here this line stops being a JSON object of numbers and texts",
                          "5:55: error: 'x' is there twice",
                          "6:39: error: here this line stops being a JSON object of numbers and texts"));
  EXPECT_THAT(traceErrorsOf(start + ",\"radius\":1,\"vx\":1}\n"),
              ElementsAre("1:1: error: all lines of a trace have both 'vx' and 'vy', or none has"));
}

TEST(TraceReader, ColumnsComeInAnyOrderAndOthersAreSkipped) {
  const Trace trace = traceOf("\xEF\xBB\xBF"
                              "note,radius,y,x,id,time,frame,vy,vx\r\n"
                              "\"a, \"\"b\"\"\n\",3,2,1,7,0.5,30,-2,-1\r\n");
  ASSERT_EQ(trace.rows.size(), 1U);
  const TraceRow& row = trace.rows[0];
  EXPECT_THAT((std::vector<double>{row.x, row.y, row.radius, row.time, row.vx, row.vy}),
              ElementsAre(1, 2, 3, 0.5, -1, -2));
  EXPECT_EQ(row.id, 7);
  EXPECT_EQ(row.frame, 30);
}

TEST(TraceReader, RowsComeInAnyOrder) {
  const Trace trace = traceOf("frame,time,id,x,y,radius\n2,0.2,1,5,0,1\n0,0,3,2,0,1\n2,0.2,0,4,0,1\n"
                              "# a remark\n\n0,0,1,1,0,1\n1,0.1,1,3,0,1\n");
  std::vector<double> xs;
  for (const TraceRow& row : trace.rows) xs.push_back(row.x);
  EXPECT_THAT(xs, ElementsAre(1, 2, 3, 4, 5));
  ASSERT_EQ(trace.frames.size(), 3U);
  EXPECT_EQ(trace.frames[2].first, 3U);
  EXPECT_EQ(trace.frames[2].count, 2U);
}

TEST(TraceReader, AHeaderAloneIsATraceOfNothing) {
  EXPECT_TRUE(traceOf("frame,time,id,x,y,radius").rows.empty());
  EXPECT_TRUE(traceOf("frame,time,id,x,y,radius\r\n\r\n").frames.empty());
}

TEST(TraceReader, TellsEveryMissingColumnAtOnce) {
  const std::string needed =
      "a trace's first line names its columns, separated by commas: frame, time, id, x, y, "
      "radius and, if known, vx, vy and group; missing: ";
  EXPECT_THAT(traceErrorsOf("frame,time,x,y\n0,0,1,2\n"),
              ElementsAre("1:1: error: " + needed + "'id', 'radius'"));
  EXPECT_THAT(traceErrorsOf("frame;time;id;x;y;radius\n"),
              ElementsAre("1:1: error: " + needed + "'frame', 'time', 'id', 'x', 'y', 'radius'"));
  EXPECT_THAT(traceErrorsOf(""),
              ElementsAre("1:1: error: " + needed + "'frame', 'time', 'id', 'x', 'y', 'radius'"));
  EXPECT_THAT(traceErrorsOf("frame,time,id,x,y,radius,vx,x\n"),
              ElementsAre("1:1: error: a trace has both 'vx' and 'vy', or neither",
                          "1:29: error: the column 'x' is there twice"));
}

TEST(TraceReader, TellsEveryWrongCellWithItsPlace) {
  EXPECT_THAT(traceErrorsOf("frame,time,id,x,y,radius\n"
                            "0,0,0,1,2,3\n"
                            "-1,0,1.5,abc,1e999,\n"
                            "1,NaN,0,NaN,-Infinity,3\n"
                            "2,1e3, 99999999999999999999 ,\"1\"2,0x3,\"3\n"),
              ElementsAre("3:1: error: 'frame' must be a whole number of at least 0, but it is \"-1\"",
                          "3:6: error: 'id' must be a whole number, but it is \"1.5\"",
                          "3:10: error: 'x' must be a number, but it is \"abc\"",
                          "3:14: error: 'y' must be a number that a double can hold, but it is \"1e999\"",
                          "3:20: error: 'radius' must be a number, but it is \"\"",
                          "4:3: error: 'time' must be finite, but it is \"NaN\"",
                          "5:8: error: 'id' must be a whole number, but it is \"99999999999999999999\"",
                          "5:35: error: 'y' must be a number, but it is \"0x3\"",
                          "5:39: error: 'radius' must be a number, but it is \"3\\x0a\"",
                          "5:39: error: this quote is never closed"));
}

TEST(TraceReader, TellsLinesThatAreTooShortOrHaveADecimalComma) {
  EXPECT_THAT(
      traceErrorsOf("frame,time,id,x,y,radius\n0,0,0,1\n0,0,0,1,5,2,5,3\n"),
      ElementsAre("2:1: error: this line has 4 cells, but the first line names 6 columns",
                  "3:1: error: this line has 8 cells, but the first line names 6 columns; numbers need a "
                  "decimal point, not a comma"));
  EXPECT_THAT(
      traceErrorsOf("frame,time,id,x,y,radius\n0,0,0,1,2,3,"),
      ElementsAre("2:1: error: this line has 7 cells, but the first line names 6 columns; numbers need a "
                  "decimal point, not a comma"));
}

TEST(TraceReader, TellsRowsThatCannotBeTogether) {
  EXPECT_THAT(traceErrorsOf("frame,time,id,x,y,radius\n0,0,0,1,2,3\n0,0,0,1,2,3\n"),
              ElementsAre("3:1: error: body 0 is twice in frame 0: also in line 2"));
  EXPECT_THAT(traceErrorsOf("frame,time,id,x,y,radius\n0,0,0,1,2,3\n0,0.5,1,1,2,3\n"),
              ElementsAre("3:1: error: frame 0 is at 0.5 s here, but at 0 s in line 2"));
  EXPECT_THAT(traceErrorsOf("frame,time,id,x,y,radius\n1,0.25,0,1,2,3\n0,0.5,0,1,2,3\n"),
              ElementsAre("2:1: error: frame 1 is at 0.25 s, before frame 0 at 0.5 s (line 3)"));
}

TEST(TraceReader, AFileThatIsNotThereIsBadInput) {
  EXPECT_THROW(static_cast<void>(readTrace("/nowhere/student.csv")), SceneError);
}

TEST(TraceReader, TruncatedInItsHeaderARowOrAQuoteItIsRefused) {
  const std::string header = "frame,time,id,x,y,radius,group\n";
  const std::string row = "0,0,0,1,2,3,\"a\nb\"";
  for (std::size_t length = 0; length < std::string("frame,time,id,x,y,radius").size(); ++length)
    EXPECT_EQ(traceErrorsOf(header.substr(0, length)).size(), 1U) << length;
  for (std::size_t length = 1; length < row.size(); ++length) {
    if (row.substr(0, length).ends_with("3,")) continue; // an empty group is one, too
    EXPECT_FALSE(traceErrorsOf(header + row.substr(0, length)).empty()) << row.substr(0, length);
  }
  EXPECT_EQ(traceOf(header + row).groups.front(), "a\nb");
}

TEST(TraceReader, AMillionRowsTakeLittleTime) {
  std::string text = "frame,time,id,x,y,vx,vy,radius\n";
  for (int frame = 1000; frame-- > 0;) { // last frame first: they must be sorted, too
    for (int id = 0; id < 1000; ++id)
      text += fmt::format("{},{},{},{}.123456789012,{}.987654321098,1.5,-2.25,20\n", frame,
                          static_cast<double>(frame) / 60.0, id, id, frame);
  }
  const auto start = std::chrono::steady_clock::now();
  const Trace trace = traceOf(text);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  ASSERT_EQ(trace.rows.size(), 1000000U);
  EXPECT_EQ(trace.rows.front().y, 0.987654321098);
  RecordProperty("seconds", fmt::format("{:.3f}", elapsed.count()));
  EXPECT_LT(elapsed.count(), 20.0) << "s; a release build takes well below 2";
}

} // namespace
} // namespace offstage::test
