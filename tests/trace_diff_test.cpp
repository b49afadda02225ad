#include "tests/support/oracle_case.h"
#include "tests/support/process.h"
#include "tests/support/reference_csv.h"
#include "tests/support/still_json.h"
#include "tests/support/temp_dir.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// `offstage diff` on traces of the reference, unpacked.
class TraceDiff : public ::testing::Test {
protected:
  [[nodiscard]] std::filesystem::path unpacked(const std::string& name) const {
    const std::string text = readReferenceText(referenceFolder() / (name + "__dt60.csv.gz"));
    return dir_.write(std::filesystem::path(name).filename().string() + ".csv", text);
  }

  TempDir dir_;
};

TEST_F(TraceDiff, OfTheSameTraceIsZero) {
  const auto trace = unpacked("trajectories/out/6a_elastic");
  const ProcessResult result = offstage({"diff", trace, trace});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("same\n"), HasSubstr("position 0 px, velocity 0 px/s, time 0 s")));
}

TEST_F(TraceDiff, NamesTheFirstFrameBodyAndQuantity) {
  const ProcessResult result = offstage(
      {"diff", unpacked("trajectories/out/2a_bounce"), unpacked("trajectories/out/2b_bounce_naive")});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("differs\n"),
                    HasSubstr("first difference: frame 121 (2.01667 s), body 0: y is 460.09272222886443, "
                              "expected 460 (off by 0.0927222 px)\n")));
}

TEST_F(TraceDiff, HoldsOffstagesOwnTracesToTheJvms) {
  const auto log = referenceFolder() / "trajectories/dt/dt60.txt";
  const auto expected = unpacked("trajectories/out/6a_elastic");
  for (const char* name : {"own.csv", "own.jsonl"}) {
    const auto own = dir_ / name;
    const auto scene = referenceFolder() / "oracle_scenes/6a_elastic.toml";
    ASSERT_EQ(offstage({"trace", scene, "--dt", log, "-o", own}).status, 0);
    const ProcessResult result = offstage({"diff", expected, own});
    EXPECT_EQ(result.status, 0) << name << ": " << result.out << result.err;
  }
}

TEST_F(TraceDiff, ToleranceIsInPixelsAndPixelsASecond) {
  const auto a = dir_.write("a.csv", "frame,time,id,x,y,vx,vy,radius\n0,0,0,1,2,3,4,5\n");
  const auto b = dir_.write("b.csv", "frame,time,id,x,y,vx,vy,radius\n0,0,0,1.5,2,3.25,4,5\n");
  EXPECT_EQ(offstage({"diff", a, b, "--max-position", "0.5", "--max-velocity", "0.25"}).status, 0);
  EXPECT_EQ(offstage({"diff", a, b, "--max-position", "0.4", "--max-velocity", "0.25"}).status, 1);
  EXPECT_EQ(offstage({"diff", a, b, "--max-position", "-1"}).status, 2);
}

TEST_F(TraceDiff, WritesJsonJunitAndHtml) {
  const ProcessResult result = offstage({"diff", unpacked("trajectories/out/6a_elastic"),
                                         unpacked("traces/6a_elastic_one_draw_changed"), "--json", "--junit",
                                         dir_ / "j.xml", "--html", dir_ / "report"});
  EXPECT_EQ(result.status, 1) << result.err;
  const JsonValue json = JsonValue::parse(result.out);
  EXPECT_FALSE(json["passed"].boolean());
  const JsonValue& one = json["cases"].array().at(0);
  EXPECT_EQ(one["first_frame"].number(), 300.0);
  EXPECT_EQ(one["first_body"].number(), 4.0);
  EXPECT_EQ(one["first_quantity"].text(), "radius");
  EXPECT_THAT(readFile(dir_ / "j.xml"), HasSubstr("first difference: frame 300"));
  EXPECT_TRUE(std::filesystem::exists(dir_ / "report/index.html"));
}

TEST_F(TraceDiff, RefusesWhatIsNoTraceAndOptionsOfPictures) {
  const auto good = dir_.write("good.csv", "frame,time,id,x,y,radius\n0,0,0,1,2,5\n");
  const auto bad = dir_.write("bad.csv", "frame,time,id,x,y,radius\n0,0,0,1,abc,5\n");
  const ProcessResult wrong = offstage({"diff", good, bad});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("bad.csv:2:9: error: 'y' must be a number, but it is \"abc\""));
  EXPECT_EQ(offstage({"diff", good, dir_ / "none.csv"}).status, 2);
  const ProcessResult option = offstage({"diff", good, good, "--max-channel", "3"});
  EXPECT_EQ(option.status, 2);
  EXPECT_THAT(option.err, HasSubstr("--max-channel means nothing to traces"));
  const std::string picture = OFFSTAGE_SOURCE_DIR "/tests/goldens/fall@4s.png";
  EXPECT_EQ(offstage({"diff", picture, picture, "--max-position", "3"}).status, 2);
  EXPECT_EQ(offstage({"diff", good, picture}).status, 2);
  EXPECT_EQ(offstage({"diff", good, good, "--match", "name"}).status, 2);
}

} // namespace
} // namespace offstage::test
