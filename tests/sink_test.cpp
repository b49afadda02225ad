#include "render/output/chunked_output.h"
#include "render/output/output_kind.h"
#include "render/output/sink.h"
#include "tests/support/output_writer.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"

#include <filesystem>
#include <limits>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

using test::errorOf;
using test::TempDir;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

SinkFormat smallFormat() {
  SinkFormat format;
  format.width = 16;
  format.height = 12;
  format.fps = 30.0;
  return format;
}

std::string makeError(const std::filesystem::path& out, const SinkFormat& format = smallFormat()) {
  return errorOf([&] {
    if (isStream(outputKind(out)))
      makeSink(out, format);
    else
      makeChunkedOutput(out, format);
  });
}

void writeTwoFrames(const std::filesystem::path& out) {
  if (!isStream(outputKind(out))) {
    EXPECT_GT(test::writeOutput(out, smallFormat(), test::fixedTimings(2, 30.0)).bytes, 0) << out;
    return;
  }
  const auto sink = makeSink(out, smallFormat());
  for (int k = 0; k < 2; ++k) sink->write(test::lectureFrame(16, 12, k), test::fixedTiming(k, 30.0));
  sink->finish();
  EXPECT_GT(sink->bytesWritten(), 0) << out;
}

TEST(Output, EndingChoosesTheFormatInAnyCase) {
  const TempDir dir;
  for (const char* name : {"a.mp4", "b.MOV", "c.Mkv", "d.raw", "e%d.PNG"}) writeTwoFrames(dir / name);
  EXPECT_THAT(dir.names(), ElementsAre("a.mp4", "b.MOV", "c.Mkv", "d.raw", "e0.PNG", "e1.PNG"));
  EXPECT_EQ(test::readFile(dir / "a.mp4").substr(4, 8), "ftypisom");
  EXPECT_EQ(test::readFile(dir / "b.MOV").substr(4, 8), "ftypqt  ");
  EXPECT_EQ(test::readFile(dir / "c.Mkv").substr(0, 4), "\x1A\x45\xDF\xA3"); // EBML's magic number
  EXPECT_EQ(test::readFile(dir / "d.raw").size(), 2U * 16 * 12 * 4);
  EXPECT_EQ(test::readFile(dir / "e1.PNG").substr(0, 4), "\x89PNG");
}

TEST(Output, ListsTheEndingsThatThereAre) {
  const std::string list =
      ".mp4, .mkv, .mov, .webm, .gif, .apng, a pattern such as frames/%06d.png, .raw (RGBA bytes), or - "
      "(RGBA bytes to standard output)";
  EXPECT_EQ(makeError("x.avi"), "2: cannot write .avi files ('x.avi'); there are " + list);
  EXPECT_EQ(makeError("x"), "2: the name 'x' has no ending that tells what to write: " + list);
  EXPECT_EQ(makeError(""), "2: the name '' has no ending that tells what to write: " + list);
  EXPECT_EQ(makeError("x.mp4/"), "2: cannot write 'x.mp4/': a name that ends in / names a folder");
  EXPECT_EQ(makeError(".mp4"), "2: the name '.mp4' has no ending that tells what to write: " + list);
}

TEST(Output, SuggestsAPatternForASinglePng) {
  EXPECT_EQ(makeError("out/x.png"),
            "2: 'out/x.png' names one picture: write 'out/x-%06d.png' for a file a frame, or use "
            "`offstage still` for a single frame");
  EXPECT_THAT(makeError("x%s.png"), StartsWith("2: bad pattern"));
}

TEST(Output, RefusesTransparencyWhereThereIsNoneAndNamesWhatHasIt) {
  const TempDir dir;
  SinkFormat format = smallFormat();
  format.alpha = true;
  for (const char* name : {"a.mp4", "a.mkv", "a.gif"}) {
    EXPECT_THAT(makeError(dir / name, format), AllOf(StartsWith("2: "), HasSubstr("no transparency"),
                                                     HasSubstr("frames/%06d.png"), HasSubstr(".raw")));
  }
  for (const char* name : {"a.mov", "a.webm", "a.apng", "a%d.png", "a.raw"})
    EXPECT_EQ(makeError(dir / name, format), "no error") << name;
  format.quality = Quality::Lossless;
  EXPECT_EQ(makeError(dir / "a.mkv", format), "no error");
  EXPECT_THAT(dir.names(), IsEmpty());
}

TEST(Output, FindsUnusableNamesBeforeTheFirstFrame) {
  const TempDir dir;
  std::filesystem::create_directory(dir / "folder.mp4");
  std::filesystem::create_directory(dir / "folder.raw");
  for (const char* ending : {".mp4", ".raw"}) {
    EXPECT_THAT(makeError(dir / ("folder" + std::string(ending))),
                AllOf(StartsWith("2: "), HasSubstr("it is a folder")));
    EXPECT_THAT(makeError(dir / ("none/a" + std::string(ending))),
                AllOf(StartsWith("2: "), HasSubstr("does not exist")));
  }
}

TEST(Output, RefusesSizesAndRatesThatNoVideoHas) {
  const TempDir dir;
  SinkFormat format = smallFormat();
  for (const double fps :
       {-1.0, 1e-9, 1e9, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    format.fps = fps;
    EXPECT_THAT(makeError(dir / "a.mp4", format),
                StartsWith("2: a video has 0.001 to 1000000 frames a second, not"))
        << fps;
  }
  format.fps = 2000.0;
  EXPECT_THAT(makeError(dir / "a.mkv", format), HasSubstr("counts in milliseconds"));
  EXPECT_EQ(makeError(dir / "a.mp4", format), "no error");
  format = smallFormat();
  format.width = 16385;
  EXPECT_THAT(makeError(dir / "a.mp4", format), HasSubstr("at most 16384 px a side, not 16385 × 12"));
  format.width = 16384;
  for (const int height : {16128, 16129, 16384}) {
    format.height = height;
    for (const char* name : {"a.mp4", "a.mov", "a.mkv", "a.webm", "a.gif", "a.apng"}) {
      const std::string error = makeError(dir / name, format);
      if (height == 16128)
        EXPECT_EQ(error, "no error") << name;
      else
        EXPECT_THAT(error, AllOf(StartsWith("2: "), HasSubstr(name), HasSubstr("at most 16128 px of height"),
                                 HasSubstr("a PNG sequence")));
    }
    EXPECT_EQ(makeError(dir / "a%d.png", format), "no error") << height;
    EXPECT_EQ(makeError(dir / "a.raw", format), "no error") << height;
  }
  format.height = 12;
  for (const int width : {0, -16}) {
    format.width = width;
    for (const char* name : {"a.mp4", "a.raw", "a%d.png", "a.gif", "a.apng"}) {
      EXPECT_THAT(makeError(dir / name, format), HasSubstr("cannot be written")) << name << ' ' << width;
    }
  }
  EXPECT_THAT(dir.names(), IsEmpty());
}

TEST(Output, RefusesSidesThatFfv1DoesNotKeep) {
  const TempDir dir;
  SinkFormat format = smallFormat();
  format.alpha = true;
  format.quality = Quality::Lossless;
  for (const auto& [width, height] : {std::pair{2, 3}, {3, 2}, {1, 1}, {100, 2}}) {
    format.width = width;
    format.height = height;
    EXPECT_THAT(makeError(dir / "a.mkv", format),
                AllOf(StartsWith("2: "), HasSubstr("at least 3 px a side"), HasSubstr(".apng")));
  }
  format.width = format.height = 3;
  EXPECT_EQ(makeError(dir / "a.mkv", format), "no error");
}

TEST(Output, RefusesAQualityThatAFormatDoesNotHave) {
  const TempDir dir;
  SinkFormat format = smallFormat();
  format.quality = Quality::Lossless;
  for (const char* name : {"a.mp4", "a.mov", "a.webm"})
    EXPECT_THAT(makeError(dir / name, format), AllOf(StartsWith("2: "), HasSubstr("use .mkv"))) << name;
  EXPECT_THAT(makeError(dir / "a.gif", format), HasSubstr("leave out --quality"));
  for (const char* name : {"a.mkv", "a.apng", "a%d.png", "a.raw"})
    EXPECT_EQ(makeError(dir / name, format), "no error") << name;
  for (const Quality quality : {Quality::Draft, Quality::Good, Quality::High}) {
    format.quality = quality;
    for (const char* name : {"a.gif", "a.apng", "a%d.png", "a.raw"})
      EXPECT_THAT(makeError(dir / name, format), AllOf(StartsWith("2: "), HasSubstr("leave out --quality")))
          << name;
    for (const char* name : {"a.mp4", "a.mkv", "a.mov", "a.webm"})
      EXPECT_EQ(makeError(dir / name, format), "no error") << name;
  }
  EXPECT_THAT(dir.names(), IsEmpty());
}

TEST(Output, UnfinishedOutputLeavesTheOlderFileAlone) {
  const TempDir dir;
  for (const char* name : {"a.mp4", "a.mkv", "a.raw"}) {
    test::writeFile(dir / name, "old");
    if (isStream(outputKind(name))) {
      const auto sink = makeSink(dir / name, smallFormat());
      for (int k = 0; k < 2; ++k) sink->write(test::lectureFrame(16, 12, k), test::fixedTiming(k, 30.0));
    } else {
      const auto output = makeChunkedOutput(dir / name, smallFormat());
      const auto writer = output->begin(dir / "chunk", 0);
      for (int k = 0; k < 2; ++k) writer->write(test::lectureFrame(16, 12, k), test::fixedTiming(k, 30.0));
    }
    EXPECT_EQ(test::readFile(dir / name), "old") << name;
    writeTwoFrames(dir / name);
    EXPECT_NE(test::readFile(dir / name), "old") << name;
  }
  EXPECT_THAT(dir.names(), ElementsAre("a.mkv", "a.mp4", "a.raw"));
}

} // namespace
} // namespace offstage
