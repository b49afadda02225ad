#include "render/output/png.h"
#include "render/output/png_sequence.h"
#include "tests/support/output_writer.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

using test::errorOf;
using test::formatOf;
using test::lectureFrame;
using test::TempDir;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string nameOf(const std::string& pattern, std::int64_t number) {
  return FramePattern(pattern).path(number).native();
}

TEST(FramePattern, NumbersAsPrintfDoes) {
  EXPECT_EQ(nameOf("%d.png", 0), "./0.png");
  EXPECT_EQ(nameOf("a/f-%d.png", 1234567), "a/f-1234567.png");
  EXPECT_EQ(nameOf("a/%06d.png", 42), "a/000042.png");
  EXPECT_EQ(nameOf("a/%03d.png", 12345), "a/12345.png");
  EXPECT_EQ(nameOf("a/100%%-%02d%%.png", 7), "a/100%-07%.png");
}

TEST(FramePattern, FoldersAreTakenLiterally) {
  EXPECT_EQ(nameOf("run %d%%/%02d.png", 3), "run %d%%/03.png");
}

TEST(FramePattern, RefusesWhatDoesNotNumberOnce) {
  const auto error = [](const char* pattern) {
    return errorOf([pattern] { const FramePattern p(pattern); });
  };
  const std::string hint =
      "; write the frame number's place once, as in frames/%06d.png (and %% for a percent sign)";
  EXPECT_EQ(error("a%%.png"), "2: bad pattern 'a%%.png': its file name has no %d" + hint);
  EXPECT_EQ(error("%d-%d.png"), "2: bad pattern '%d-%d.png': it has more than one %d" + hint);
  EXPECT_EQ(error("%6d.png"),
            "2: bad pattern '%6d.png': %6d would fill up with spaces, %06d fills up with zeros" + hint);
  EXPECT_EQ(error("%s.png"), "2: bad pattern '%s.png': '%s' is no place for a number" + hint);
  EXPECT_EQ(error("%06x.png"), "2: bad pattern '%06x.png': '%06x' is no place for a number" + hint);
  EXPECT_EQ(error("a%"), "2: bad pattern 'a%': '%' is no place for a number" + hint);
  EXPECT_EQ(error("a%0"), "2: bad pattern 'a%0': '%0' is no place for a number" + hint);
  EXPECT_EQ(error("%0d.png"), "2: bad pattern '%0d.png': %0d does not have 1 to 18 digits" + hint);
  EXPECT_EQ(error("%019d.png"), "2: bad pattern '%019d.png': %019d does not have 1 to 18 digits" + hint);
  EXPECT_EQ(error("%099999999999d.png"),
            "2: bad pattern '%099999999999d.png': %099999999999d does not have 1 to 18 digits" + hint);
  EXPECT_EQ(error("%d/a.png"), "2: bad pattern '%d/a.png': its file name has no %d" + hint);
}

TEST(FramePattern, KnowsItsOwnNames) {
  const FramePattern pattern("a/f%03d.png");
  EXPECT_EQ(pattern.numberOf("f007.png"), std::optional<std::int64_t>(7));
  EXPECT_EQ(pattern.numberOf("f1234.png"), std::optional<std::int64_t>(1234));
  for (const char* other : {"f07.png", "f0007.png", "f-07.png", "f.png", "g007.png", "f007.png~", "f007", "",
                            "f00x.png", "f99999999999999999999.png"}) {
    EXPECT_EQ(pattern.numberOf(other), std::nullopt) << other;
  }
}

TEST(FramePattern, KnowsHowItsNamesBegin) {
  const FramePattern pattern("a/f%03d7.png");
  for (const char* begin : {"", "f", "f0", "f007", "f0077", "f0077.p", "f123457.png"})
    EXPECT_TRUE(pattern.mayBeginWith(begin)) << begin;
  for (const char* other : {"g", "fx", "f07.", "f0078.png", "f007.png", "f0077.png~"})
    EXPECT_FALSE(pattern.mayBeginWith(other)) << other;
}

TEST(PngSequence, MakesTheFolderAndNumbersFromZero) {
  const TempDir dir;
  const test::Written written =
      test::writeOutput(dir / "deep/er/f%02d.png", formatOf(40, 30), test::fixedTimings(3, 60.0));
  EXPECT_THAT(dir.names("deep/er"), ElementsAre("f00.png", "f01.png", "f02.png"));
  std::int64_t bytes = 0;
  for (int k = 0; k < 3; ++k) {
    const std::vector<std::uint8_t> png = encodePng(lectureFrame(40, 30, k), false);
    EXPECT_EQ(test::readFile(dir / fmt::format("deep/er/f0{}.png", k)), std::string(png.begin(), png.end()))
        << k;
    bytes += static_cast<std::int64_t>(png.size());
  }
  EXPECT_EQ(written.bytes, bytes);
  EXPECT_EQ(written.notice, "");
}

TEST(PngSequence, TransparentBackgroundGivesRgba) {
  const TempDir dir;
  SinkFormat format = formatOf(8, 8);
  format.alpha = true;
  test::writeOutput(dir / "%d.png", format, {{0, 0, 1}}, [](int) { return test::noiseFrame(8, 8, 1); });
  EXPECT_EQ(test::readFile(dir / "0.png").at(25), 6) << "colour type";
}

TEST(PngSequence, InterruptedRunLeavesWholeFramesOnly) {
  const TempDir dir;
  {
    const PngSequenceOutput output(dir / "%d.png", formatOf(40, 30));
    const auto writer = output.begin(dir / "chunk", 0);
    for (int k = 0; k < 2; ++k) writer->write(lectureFrame(40, 30, k), test::fixedTiming(k, 60.0));
  }
  EXPECT_THAT(dir.names(), ElementsAre("0.png", "1.png"));
}

TEST(PngSequence, TellsOfFramesThatAnEarlierRunLeft) {
  const TempDir dir;
  for (const char* name : {"0.png", "1.png", "2.png", "10.png", "x.png", "002.png"})
    test::writeFile(dir / name, "old");
  const test::Written written =
      test::writeOutput(dir / "%d.png", formatOf(8, 6), test::fixedTimings(2, 60.0));
  EXPECT_EQ(written.notice,
            "'" + dir.path().native() + "' holds 2 frames of an earlier run with higher numbers than 1");
  EXPECT_EQ(test::readFile(dir / "10.png"), "old");
  EXPECT_NE(test::readFile(dir / "1.png"), "old");
}

TEST(PngSequence, AChunkIsWholeOnlyWithAllItsPictures) {
  const TempDir dir;
  PngSequenceOutput output(dir / "%d.png", formatOf(40, 30));
  const auto writer = output.begin(dir / "chunk", 0);
  for (int k = 0; k < 2; ++k) writer->write(lectureFrame(40, 30, k), test::fixedTiming(k, 60.0));
  writer->finish();
  EXPECT_TRUE(output.isWhole(dir / "chunk"));
  const std::string picture = test::readFile(dir / "1.png");
  test::writeFile(dir / "1.png", picture.substr(1));
  EXPECT_FALSE(output.isWhole(dir / "chunk"));
  EXPECT_THAT(errorOf([&] { output.join(std::vector<std::filesystem::path>{dir / "chunk"}, 2); }),
              StartsWith("75: pictures of "));
  test::writeFile(dir / "1.png", picture);
  EXPECT_TRUE(output.isWhole(dir / "chunk"));
  std::filesystem::remove(dir / "0.png");
  EXPECT_FALSE(output.isWhole(dir / "chunk"));
}

TEST(PngSequence, RefusesAFolderThatCannotBe) {
  const TempDir dir;
  test::writeFile(dir / "file", "");
  EXPECT_THAT(errorOf([&dir] { const PngSequenceOutput output(dir / "file/%d.png", formatOf(8, 6)); }),
              HasSubstr("2: cannot write"));
  EXPECT_THAT(errorOf([&dir] { PngSequenceOutput(dir / "%d.png", formatOf(8, 6)).join({}, 0); }),
              StartsWith("2: 0 frames"));
  EXPECT_THAT(dir.names(), ElementsAre("file"));
}

} // namespace
} // namespace offstage
