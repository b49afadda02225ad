#include "render/output/png.h"
#include "src/scene/utf8.h"
#include "tests/support/png_build.h"
#include "tests/support/process.h"
#include "tests/support/still_json.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;

std::string pngText(const Frame& frame) {
  const std::vector<std::uint8_t> png = encodePng(frame, true);
  return {png.begin(), png.end()};
}

Frame changed(Frame frame, int x, int y) {
  frame.rgba[4 * pixelIndex(y, frame.width, x)] ^= 0xFF;
  return frame;
}

class DiffCommand : public ::testing::Test {
protected:
  std::string put(const std::string& name, const Frame& frame) const {
    return dir_.write(name, pngText(frame)).string();
  }
  std::string folder(const std::string& name, int frames, int changedFrom) const {
    std::filesystem::create_directory(dir_ / name);
    for (int i = 0; i < frames; ++i) {
      const Frame frame = lectureFrame(64, 48, i);
      put(fmt::format("{}/f{}.png", name, i), i >= changedFrom ? changed(frame, 5, 6) : frame);
    }
    return (dir_ / name).string();
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (dir_ / name).string(); }

  TempDir dir_;
  const Frame frame_ = lectureFrame(64, 48, 3);
};

TEST_F(DiffCommand, AnAnimatedPngKeepsItsTimesOverManyFrames) {
  const std::string scene =
      dir_.write("s.toml", "duration = 10\n[frame]\nsize = [32, 24]\n[[body]]\ncenter = [5, 9]\n"
                           "radius = 3\nvelocity = [2, 1]\n")
          .string();
  for (const std::vector<std::string>& made :
       std::vector<std::vector<std::string>>{{"x.apng"}, {"x.mkv", "--quality", "lossless"}}) {
    std::vector<std::string> command{"render", scene, "-o", path(made[0])};
    command.insert(command.end(), made.begin() + 1, made.end());
    ASSERT_EQ(offstage(command).status, 0);
  }
  const ProcessResult result = offstage({"diff", path("x.mkv"), path("x.apng")});
  EXPECT_EQ(result.status, 0)
      << result.out; // 600 frames of 1/60 s, which are 2 ms off after ten seconds in 1/100000 s
}

TEST_F(DiffCommand, ReplacesNothingThatItCompares) {
  const std::string a = put("a.png", frame_);
  const std::string b = put("b.png", changed(frame_, 20, 30));
  const std::string frames = folder("frames", 2, 2);
  const std::string trace =
      dir_.write("t.csv", "frame,id,time,x,y,vx,vy,radius,group\n0,0,0,1,2,3,4,5,\n").string();
  const std::string tolerance = dir_.write("tol.toml", "max_channel = 3\n").string();
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {a, b, "--strip", a},
           {a, b, "--strip", path("frames/../b.png")},
           {a, b, "--strip", path("x.png"), "--junit", path("x.png")},
           {frames, frames, "--strip", path("frames/worst.png")},
           {frames, path("frames/f%d.png"), "--strip", path("frames/f1.png")},
           {trace, trace, "--junit", trace},
           {a, b, "--tolerance", tolerance, "--junit", tolerance},
           {a, a, "--mask", b, "--strip", b}}) {
    std::vector<std::string> command{"diff"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const auto before = std::pair(readFile(a), readFile(b));
    const ProcessResult result = offstage(command);
    EXPECT_EQ(result.status, 2) << arguments.back() << "\n" << result.err;
    EXPECT_THAT(result.err, HasSubstr("cannot b")) << arguments.back();
    EXPECT_EQ(std::pair(readFile(a), readFile(b)), before) << arguments.back();
  }
  EXPECT_EQ(offstage({"diff", frames, frames, "--junit", path("frames/junit.xml")}).status, 0);
}

TEST_F(DiffCommand, ExitStatusSaysSameOrDifferent) {
  const std::string a = put("a.png", frame_);
  const std::string b = put("b.png", frame_);
  const std::string c = put("c.png", changed(frame_, 20, 30));
  const ProcessResult same = offstage({"diff", a, b});
  EXPECT_EQ(same.status, 0) << same.err;
  EXPECT_THAT(same.out, StartsWith("same\n  tolerance: no pixel unequal\n"));
  const ProcessResult differs = offstage({"diff", a, c, "--metric", "all"});
  EXPECT_EQ(differs.status, 1) << differs.err;
  EXPECT_THAT(differs.out,
              AllOf(StartsWith("differs\n"), HasSubstr("1 px differ, 0 allowed"),
                    HasSubstr("bounding box (x, y, width, height)  20, 30, 1, 1 px"), HasSubstr("PSNR"),
                    HasSubstr("SSIM"), HasSubstr("pixelmatch"), HasSubstr("FLIP third weighted quartile"),
                    HasSubstr("    20, 30: (255, 255, 255), (0, 255, 255)")));
  EXPECT_EQ(differs.err, "");
}

TEST_F(DiffCommand, JsonHoldsTheNumbers) {
  const std::string a = put("a.png", frame_);
  const std::string c = put("c.png", changed(frame_, 20, 30));
  const ProcessResult result = offstage({"diff", a, c, "--json", "--metric", "all"});
  EXPECT_EQ(result.status, 1);
  const JsonValue json = JsonValue::parse(result.out);
  EXPECT_FALSE(json["passed"].boolean());
  EXPECT_EQ(json["verdict"].text(), "differs");
  const JsonValue& one = json["cases"].array().at(0);
  EXPECT_EQ(one["differing_pixels"].number(), 1.0);
  EXPECT_EQ(one["bounding_box"].array().at(1).number(), 30.0);
  EXPECT_EQ(one["pixelmatch"].number(), 1.0);
  EXPECT_GT(one["flip_max"].number(), 0.1);
  EXPECT_EQ(one["worst_pixels"].array().at(0)["x"].number(), 20.0);
  const JsonValue same = JsonValue::parse(offstage({"diff", a, a, "--json"}).out);
  EXPECT_TRUE(same["cases"].array().at(0)["psnr"].isNull()) << "infinite";
}

TEST_F(DiffCommand, AnotherSizeIsADifferenceOfItsOwnKind) {
  const std::string a = put("a.png", frame_);
  const std::string b = put("b.png", lectureFrame(65, 48, 3));
  const ProcessResult result = offstage({"diff", a, b, "--strip", path("s.png")});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_THAT(result.out, HasSubstr("size differs: expected 64x48 px, actual 65x48 px"));
  EXPECT_TRUE(std::filesystem::exists(path("s.png")));
}

TEST_F(DiffCommand, ABrokenFileNeverGetsAVerdict) {
  const std::string good = pngText(frame_);
  const std::string a = put("a.png", frame_);
  std::string wrongCrc = good;
  wrongCrc[good.find("IDAT") + 20] ^= 1;
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "is empty"},
      {good.substr(0, good.size() - 12), "no IEND chunk"},
      {good.substr(0, good.size() / 2), "is truncated"},
      {wrongCrc, "CRC of chunk IDAT"},
      {pngOf(pngHeader(0x7FFFFFFFU, 0x7FFFFFFFU, 8, 2), ""), "more than the limit of 268435456 pixels"},
      {"plain text", "cannot be read as PNG, JPEG or BMP"},
  };
  for (const auto& [bytes, reason] : cases) {
    const std::string b = dir_.write("b.png", bytes).string();
    for (const auto& [x, y] : {std::pair(a, b), std::pair(b, a), std::pair(b, b)}) {
      const ProcessResult result = offstage({"diff", x, y});
      EXPECT_EQ(result.status, 2) << reason << result.out;
      EXPECT_EQ(result.out, "") << reason;
      EXPECT_THAT(result.err, HasSubstr(b)) << reason;
      EXPECT_THAT(result.err, HasSubstr(reason));
    }
  }
  EXPECT_THAT(offstage({"diff", a, dir_.write("c.png", good + "tail").string()}).out,
              AllOf(StartsWith("same"), HasSubstr("c.png' has 4 bytes after IEND, which are ignored")));
}

TEST_F(DiffCommand, WithoutAVerdictTheJunitFileHoldsTheError) {
  const std::string a = put("a.png", frame_);
  const std::string b = put("b.png", frame_);
  const std::string junit = path("x.xml");
  ASSERT_EQ(offstage({"diff", a, b, "--junit", junit}).status, 0);
  dir_.write("b.png", pngText(frame_).substr(0, 200));
  EXPECT_EQ(offstage({"diff", a, b, "--junit", junit}).status, 2);
  EXPECT_THAT(readFile(junit), AllOf(HasSubstr("tests=\"1\" failures=\"0\" errors=\"1\""),
                                     HasSubstr("<error message="), HasSubstr("is truncated")));
  ASSERT_EQ(offstage({"diff", a, a, "--junit", junit}).status, 0);
  EXPECT_THAT(readFile(junit), HasSubstr("errors=\"0\""));
  // What is no such report stays, and what is compared is not even looked at.
  const std::string notes = dir_.write("notes.xml", "<notes/>").string();
  EXPECT_EQ(offstage({"diff", a, b, "--junit", notes}).status, 2);
  EXPECT_EQ(readFile(notes), "<notes/>");
}

TEST_F(DiffCommand, NamesThatAreNotUtf8AreRepairedInJsonAndJunit) {
  folder("f1", 0, 0);
  folder("f2", 0, 0);
  put("f1/q\x01\xff.png", frame_);
  put("f2/q\x01\xff.png", changed(frame_, 20, 30));
  const ProcessResult result = offstage({"diff", path("f1"), path("f2"), "--json", "--junit", path("x.xml")});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_THAT(result.out, HasSubstr("q\\u0001\uFFFD"));
  EXPECT_THAT(readFile(path("x.xml")), HasSubstr("q\uFFFD\uFFFD"));
  EXPECT_NO_THROW(static_cast<void>(decodeUtf8(result.out)));
  EXPECT_NO_THROW(static_cast<void>(decodeUtf8(readFile(path("x.xml")))));
}

TEST_F(DiffCommand, ASharesPercentHasTheDigitsThatWereGiven) {
  const std::string a = put("a.png", frame_);
  EXPECT_THAT(offstage({"diff", a, a, "--max-ratio", "0.07"}).out,
              HasSubstr("at most 7 % of the pixels unequal"));
  EXPECT_THAT(offstage({"diff", a, a, "--max-ratio", "0.000123"}).out, HasSubstr("at most 0.0123 % of"));
}

TEST_F(DiffCommand, BadUsageIsStatus2AndWritesNothing) {
  const std::string a = put("a.png", frame_);
  const std::string frames = folder("frames", 1, 9);
  dir_.write("t.toml", "max_chanel = 3\nmax_ratio = 2\n");
  std::filesystem::create_directory(dir_ / "full");
  dir_.write("full/mine.txt", "mine");
  std::filesystem::create_directory(dir_ / "none");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{a}, "ACTUAL"},
      {{a, path("missing.png")}, "missing.png' cannot be read"},
      {{a, frames}, "one picture, and many"},
      {{frames, path("none")}, "holds no pictures"},
      {{frames, path("x%d.png")}, "there is no picture"},
      {{a, a, "--metric", "best"}, "--metric"},
      {{a, a, "--max-channel", "nan"}, "--max-channel 'nan'"},
      {{a, a, "--max-channel", "256"}, "not from 0 to 255"},
      {{a, a, "--max-differing", "-1"}, "--max-differing '-1'"},
      {{a, a, "--max-ratio", "1.5"}, "--max-ratio"},
      {{a, a, "--ignore", "1,2,3"}, "--ignore '1,2,3'"},
      {{a, a, "--ignore", "1,2,-3,4"}, "--ignore"},
      {{a, a, "--max-pixels", "100"}, "more than the limit of 100 pixels"},
      {{a, a, "--mask", path("nomask.png")}, "nomask.png"},
      {{a, a, "--tolerance", path("none.toml")}, "none.toml"},
      {{a, a, "--tolerance", path("t.toml")},
       "t.toml:1:1: error: unknown key 'max_chanel'; did you mean 'max_channel'?"},
      {{a, a, "--tolerance", path("t.toml")}, "t.toml:2:13: error: 'max_ratio' must be"},
      {{a, a, "--strip", path("s.jpg")}, ".png"},
      {{a, a, "--strip", path("nowhere/s.png")}, "nowhere"},
      {{a, a, "--junit", path("nowhere/j.xml")}, "nowhere"},
      {{a, a, "--html", path("nowhere/report")}, "nowhere"},
      {{a, a, "--html", path("full")}, "holds other files"},
  };
  const std::vector<std::string> before = dir_.names();
  for (const auto& [arguments, text] : cases) {
    std::vector<std::string> all{"diff"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const ProcessResult result = offstage(all);
    EXPECT_EQ(result.status, 2) << text << "\n" << result.err;
    EXPECT_THAT(result.err, HasSubstr(text));
    EXPECT_EQ(result.out, "") << text;
  }
  EXPECT_EQ(dir_.names(), before);
  EXPECT_EQ(readFile(dir_ / "full/mine.txt"), "mine");
}

TEST_F(DiffCommand, ToleranceComesFromTheFileBesideAndTheCommandLine) {
  const std::string a = put("a.png", frame_);
  const std::string c = put("c.png", changed(frame_, 20, 30));
  EXPECT_EQ(offstage({"diff", a, c, "--max-differing", "1"}).status, 0);
  EXPECT_EQ(offstage({"diff", "--ignore", "1,1,2,2", "--ignore", "20,30,1,1", a, c}).status, 0);
  EXPECT_EQ(offstage({"diff", a, c, "--max-channel", "254"}).status, 1);
  EXPECT_EQ(offstage({"diff", a, c, "--max-channel", "255"}).status, 0);
  dir_.write("tolerance.toml", "max_pixels = 1\nignore = [[1, 1, 2, 2]]\n");
  const ProcessResult beside = offstage({"diff", a, c});
  EXPECT_EQ(beside.status, 0) << beside.out;
  EXPECT_THAT(beside.out, HasSubstr("tolerance: at most 1 px unequal, 1 region ignored (" +
                                    path("tolerance.toml") + ")"));
  EXPECT_EQ(offstage({"diff", a, c, "--max-differing", "0"}).status, 1) << "the command line replaces it";
}

TEST_F(DiffCommand, FoldersArePairedByNameAndMissingFramesAreTold) {
  const std::string a = folder("a", 12, 99);
  const std::string b = folder("b", 12, 10);
  const ProcessResult result = offstage({"diff", a, b, "--fps", "4", "--json", "--junit", path("j.xml")});
  EXPECT_EQ(result.status, 1) << result.err;
  const JsonValue json = JsonValue::parse(result.out);
  EXPECT_EQ(json["frames"].number(), 12.0);
  EXPECT_EQ(json["differing_frames"].number(), 2.0);
  EXPECT_EQ(json["first_differing_frame"].number(), 10.0) << "f2 comes before f10";
  EXPECT_EQ(json["first_differing_time"].number(), 2.5);
  EXPECT_EQ(json["cases"].array().size(), 12U);
  EXPECT_EQ(json["curves"].array().at(0)["values"].array().at(11).number(), 1.0);
  EXPECT_THAT(readFile(dir_ / "j.xml"),
              AllOf(HasSubstr("tests=\"13\" failures=\"3\""),
                    HasSubstr("<testcase classname=\"offstage.diff\" name=\"f0.png\""),
                    HasSubstr("first differing frame: f10.png (2.500 s): 1 px differ, 0 allowed")));
  std::filesystem::remove(dir_ / "b/f3.png");
  put("b/g.png", frame_);
  const ProcessResult counts = offstage({"diff", a, b});
  EXPECT_EQ(counts.status, 1);
  EXPECT_THAT(counts.out,
              AllOf(StartsWith("frame count differs\n"), HasSubstr("expected 12, actual 12"),
                    HasSubstr("f3.png: missing frame"), HasSubstr("g.png: extra frame"),
                    HasSubstr("first differing frame: f3.png: only the expected sequence has it")));
  dir_.write("b/f1.png", "broken");
  const ProcessResult broken = offstage({"diff", a, b});
  EXPECT_EQ(broken.status, 2) << broken.out;
  EXPECT_THAT(broken.err, HasSubstr("f1.png"));
}

TEST_F(DiffCommand, PatternsArePairedByNumber) {
  folder("a", 3, 99);
  folder("b", 4, 2);
  const ProcessResult result = offstage({"diff", path("a/f%d.png"), path("b/f%d.png")});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("frame count differs: expected 3, actual 4"), HasSubstr("2 of 4 frames differ"),
                    HasSubstr("first differing frame: f2.png")));
}

TEST_F(DiffCommand, VideosAreComparedFrameByFrameWithTimes) {
  const std::string a = path("a.mp4");
  const std::string b = path("b.mp4");
  const std::string shorter = path("c.mp4");
  ASSERT_EQ(offstage({"render", scene("fall"), "-o", a, "--duration", "1"}).status, 0);
  ASSERT_EQ(offstage({"render", scene("fall"), "-o", b, "--duration", "1", "--scale", "1"}).status, 0);
  ASSERT_EQ(offstage({"render", scene("fall"), "-o", shorter, "--duration", "0.5"}).status, 0);
  const ProcessResult same = offstage({"diff", a, b});
  EXPECT_EQ(same.status, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr("0 of 60 frames differ"));
  const ProcessResult counts = offstage({"diff", a, shorter, "--json"});
  EXPECT_EQ(counts.status, 1);
  const JsonValue json = JsonValue::parse(counts.out);
  EXPECT_EQ(json["verdict"].text(), "frame count differs");
  EXPECT_EQ(json["missing_frames"].number(), 30.0);

  // A video against the frames that it was made from: they differ by what encoding loses, no more.
  std::filesystem::create_directory(dir_ / "frames");
  ASSERT_EQ(offstage({"render", scene("fall"), "-o", path("frames/%04d.png"), "--duration", "1"}).status, 0);
  EXPECT_EQ(offstage({"diff", path("frames"), a}).status, 1);
  const ProcessResult near = offstage({"diff", path("frames"), a, "--ssim-min", "0.99"});
  EXPECT_EQ(near.status, 0) << near.out;
  EXPECT_EQ(offstage({"diff", a, path("frames/%04d.png"), "--ssim-min", "0.99"}).status, 0);

  // Cut off in the middle.
  const std::string whole = readFile(a);
  const std::string cut = dir_.write("cut.mkv", whole.substr(0, whole.size() / 2)).string();
  const ProcessResult broken = offstage({"diff", a, cut});
  EXPECT_EQ(broken.status, 2) << broken.out;
  EXPECT_THAT(broken.err, HasSubstr("cut.mkv"));
}

TEST_F(DiffCommand, AFrameShownAtAnotherTimeIsADifference) {
  const std::string a = path("a.mp4");
  const std::string b = path("b.mp4");
  ASSERT_EQ(offstage({"render", scene("recorded_dt"), "-o", a, "--duration", "1"}).status, 0);
  ASSERT_EQ(offstage({"render", scene("recorded_dt"), "-o", b, "--duration", "1", "--fps", "60"}).status, 0);
  const ProcessResult result = offstage({"diff", a, b});
  EXPECT_EQ(result.status, 1) << result.out;
  EXPECT_THAT(result.out, HasSubstr("shown at"));
}

TEST_F(DiffCommand, TheReportIsOneFolderAndReplacesAnEarlierOne) {
  const std::string a = folder("a", 3, 99);
  const std::string b = folder("b", 3, 1);
  const std::string html = path("report");
  EXPECT_EQ(offstage({"diff", a, b, "--html", html}).status, 1);
  EXPECT_THAT(dir_.names("report"), UnorderedElementsAre("index.html", "report.css", "report.js"));
  const std::string page = readFile(dir_ / "report/index.html");
  EXPECT_THAT(page, AllOf(HasSubstr("f1.png"), Not(HasSubstr("@DATA@")), Not(HasSubstr("http://")),
                          Not(HasSubstr("https://"))));
  const std::size_t begin = page.find("id=\"data\">") + 10;
  const JsonValue data = JsonValue::parse(page.substr(begin, page.find("</script>", begin) - begin));
  const JsonValue& failed = data["cases"].array().at(1);
  EXPECT_THAT(failed["accept"].text(), StartsWith("cp " + path("b/f1.png")));
  EXPECT_THAT(failed["pictures"].array().at(0)["actual"].text(), StartsWith("iVBORw0KGgo"))
      << "a PNG in base64";
  EXPECT_EQ(offstage({"diff", a, a, "--html", html}).status, 0);
  EXPECT_THAT(readFile(dir_ / "report/index.html"), HasSubstr("\"passed\": true"));
}

} // namespace
} // namespace offstage::test
