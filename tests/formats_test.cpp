#include "render/output/sink.h"
#include "tests/support/frame_decode.h"
#include "tests/support/output_writer.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr int kFrames = 60; // two chunks

/// The lecture's circles over nothing: an antialiased edge is the circle's colour, partly transparent.
Frame transparentFrame(int number) {
  Frame frame = lectureFrame(kWidth, kHeight, number);
  for (std::size_t i = 0; i < frame.rgba.size(); i += 4) {
    const std::uint8_t least = std::min({frame.rgba[i], frame.rgba[i + 1], frame.rgba[i + 2]});
    frame.rgba[i + 3] = static_cast<std::uint8_t>(255 - least);
    if (least == 255) frame.rgba[i] = frame.rgba[i + 1] = frame.rgba[i + 2] = 0;
  }
  return frame;
}

struct FormatCase {
  std::string name;
  std::optional<Quality> quality;
  bool alpha = false;
  double mean = 0.0;      ///< of |difference| in levels, over red, green and blue; alpha premultiplied
  double alphaMean = 0.0; ///< of alpha's |difference| in levels
};

/// Colours count as much as they are opaque: no codec keeps those of what is not seen.
Frame premultiplied(Frame frame) {
  for (std::size_t i = 0; i < frame.rgba.size(); ++i)
    if (i % 4 != 3)
      frame.rgba[i] = static_cast<std::uint8_t>(frame.rgba[i] * frame.rgba[i - i % 4 + 3] / 255);
  return frame;
}

class Formats : public ::testing::TestWithParam<FormatCase> {};

TEST_P(Formats, EveryFrameDecodesToWhatWasDrawnAtItsTime) {
  const FormatCase& format = GetParam();
  const TempDir dir;
  SinkFormat sink = formatOf(kWidth, kHeight, 30.0);
  sink.alpha = format.alpha;
  sink.quality = format.quality;
  const auto drawn = [&](int k) {
    return format.alpha ? transparentFrame(k) : lectureFrame(kWidth, kHeight, k);
  };
  writeOutput(dir / format.name, sink, fixedTimings(kFrames, 30.0), drawn);
  const std::vector<ShownFrame> frames = decodeFrames(dir / format.name);
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(kFrames));
  double worstMean = 0.0;
  double alphaMean = 0.0;
  for (int k = 0; k < kFrames; ++k) {
    const ShownFrame& shown = frames[static_cast<std::size_t>(k)];
    EXPECT_NEAR(shown.start, k / 30.0, 0.0051) << "frame " << k; // .gif counts in 1/100 s
    const FrameDifference difference = compareFrames(premultiplied(shown.frame), premultiplied(drawn(k)));
    worstMean = std::max(worstMean, difference.mean);
    alphaMean = std::max(alphaMean, difference.meanAlpha);
  }
  EXPECT_LE(worstMean, format.mean);
  EXPECT_LE(alphaMean, format.alphaMean);
}

// The reasons of the tolerances: 0 where nothing is lost. 4:2:0 alone, taken from the nearest sample as here,
// makes a mean of 1.1 of these small pictures, nearly all of it at the coloured edges; the codecs' own loss
// at each quality comes on top. ProRes is 4:4:4. .gif has 255 of the clip's 700 colours.
INSTANTIATE_TEST_SUITE_P(All, Formats,
                         ::testing::Values(FormatCase{"good.mp4", {}, false, 2.0, 0},
                                           FormatCase{"good.mov", {}, false, 2.0, 0},
                                           FormatCase{"good.mkv", {}, false, 2.0, 0},
                                           FormatCase{"high.mp4", Quality::High, false, 1.6, 0},
                                           FormatCase{"draft.mp4", Quality::Draft, false, 3.5, 0},
                                           FormatCase{"good.webm", {}, false, 2.5, 0},
                                           FormatCase{"alpha.webm", {}, true, 2.5, 1.5},
                                           FormatCase{"alpha.mov", {}, true, 1.0, 0.1},
                                           FormatCase{"lossless.mkv", Quality::Lossless, false, 0.0, 0},
                                           FormatCase{"lossless-alpha.mkv", Quality::Lossless, true, 0.0, 0},
                                           FormatCase{"a.apng", {}, false, 0.0, 0},
                                           FormatCase{"alpha.apng", {}, true, 0.0, 0},
                                           FormatCase{"a.gif", {}, false, 1.0, 0}),
                         [](const ::testing::TestParamInfo<FormatCase>& tested) {
                           std::string name = tested.param.name;
                           for (char& c : name)
                             if (c == '.' || c == '-') c = '_';
                           return name;
                         });

/// A frame in which every pixel differs from its neighbours and from the frame before.
Frame smallFrame(int width, int height, int number, bool alpha) {
  Frame frame = noiseFrame(width, height, static_cast<std::uint32_t>(number + 1));
  for (std::size_t i = 3; !alpha && i < frame.rgba.size(); i += 4) frame.rgba[i] = 255;
  return frame;
}

TEST(Formats, WhatLosesNothingLosesNothingOfTheSmallestPictures) {
  const TempDir dir;
  for (const auto& [width, height] :
       {std::pair{1, 1}, {1, 7}, {7, 1}, {2, 2}, {3, 3}, {3, 5}, {353, 3}, {3, 289}}) {
    for (const bool alpha : {false, true}) {
      for (const char* name : {"a.mkv", "a.apng"}) {
        if (alpha && name == std::string("a.mkv") && std::min(width, height) < 3) continue; // is refused
        SinkFormat format = formatOf(width, height, 30.0);
        format.alpha = alpha;
        format.quality = Quality::Lossless;
        writeOutput(dir / name, format, fixedTimings(3, 30.0), [&, size = std::pair{width, height}](int k) {
          return smallFrame(size.first, size.second, k, alpha);
        });
        const std::vector<ShownFrame> frames = decodeFrames(dir / name);
        ASSERT_EQ(frames.size(), 3U) << name << ' ' << width << 'x' << height;
        for (int k = 0; k < 3; ++k) {
          const FrameDifference difference =
              compareFrames(frames[static_cast<std::size_t>(k)].frame, smallFrame(width, height, k, alpha));
          EXPECT_EQ(difference.worst, 0) << name << ' ' << width << 'x' << height << (alpha ? " alpha" : "");
          EXPECT_EQ(difference.meanAlpha, 0.0) << name << ' ' << width << 'x' << height;
        }
      }
    }
  }
}

TEST(Formats, BetterQualitiesAreCloserAndLarger) {
  const TempDir dir;
  for (const std::string ending : {"mp4", "webm"}) {
    double before = 1e9;
    std::int64_t bytes = 0;
    for (const Quality quality : {Quality::Draft, Quality::Good, Quality::High}) {
      SinkFormat format = formatOf(kWidth, kHeight, 30.0);
      format.quality = quality;
      const std::filesystem::path out = dir / fmt::format("{}.{}", qualityName(quality), ending);
      const Written written = writeOutput(out, format, fixedTimings(30, 30.0));
      double mean = 0.0;
      const std::vector<ShownFrame> frames = decodeFrames(out);
      for (int k = 0; k < 30; ++k)
        mean += compareFrames(frames.at(static_cast<std::size_t>(k)).frame, lectureFrame(kWidth, kHeight, k))
                    .mean /
                30;
      EXPECT_LT(mean, before) << out;
      EXPECT_GT(written.bytes, bytes) << out;
      before = mean;
      bytes = written.bytes;
    }
  }
}

TEST(Formats, SameFramesGiveTheSameBytes) {
  const TempDir dir;
  for (const char* ending : {"webm", "gif", "apng"}) {
    writeOutput(dir / fmt::format("a.{}", ending), formatOf(64, 48, 30.0), fixedTimings(30, 30.0));
    writeOutput(dir / fmt::format("b.{}", ending), formatOf(64, 48, 30.0), fixedTimings(30, 30.0));
    EXPECT_TRUE(readFile(dir / fmt::format("a.{}", ending)) == readFile(dir / fmt::format("b.{}", ending)))
        << ending;
  }
}

TEST(Gif, HasAtMost50FramesASecondAndLastsAsLong) {
  const TempDir dir;
  for (const auto& [fps, kept] : {std::pair{60.0, 30.0}, {50.0, 50.0}, {120.0, 40.0}, {25.0, 25.0}}) {
    const int count = static_cast<int>(fps) * 2;
    const Written written = writeOutput(dir / "a.gif", formatOf(80, 60, fps), fixedTimings(count, fps),
                                        [](int k) { return lectureFrame(80, 60, k % 50); });
    EXPECT_EQ(written.notice.empty(), fps <= 50.0) << written.notice;
    const std::vector<ShownFrame> frames = decodeFrames(dir / "a.gif");
    EXPECT_EQ(frames.size(), static_cast<std::size_t>(kept * 2)) << fps;
    double end = 0.0;
    for (const ShownFrame& shown : frames) {
      EXPECT_GE(shown.duration, 0.02 - 1e-9) << fps;
      EXPECT_NEAR(shown.start, end, 1e-9) << fps;
      end = shown.start + shown.duration;
    }
    EXPECT_NEAR(end, 2.0, 1e-9) << fps;
  }
}

TEST(Gif, VariableRateFollowsTheRecording) {
  const TempDir dir;
  std::vector<std::int64_t> durations(30, 7000000); // 7 ms: most are too short to be shown
  durations[10] = 500000000;
  const std::vector<FrameTiming> timings = timingsOf(durations);
  writeOutput(dir / "a.gif", formatOf(80, 60, 0.0), timings);
  const std::vector<ShownFrame> frames = decodeFrames(dir / "a.gif");
  for (const ShownFrame& shown : frames) EXPECT_GE(shown.duration, 0.02 - 1e-9);
  EXPECT_NEAR(frames.back().start + frames.back().duration, static_cast<double>(timings.back().end) / 1e9,
              0.0101);
}

TEST(Gif, FewColoursAreKeptExactly) {
  const TempDir dir;
  const auto drawn = [](int k) {
    Frame frame = flatFrame(40, 30, {static_cast<std::uint8_t>(8 * k), 100, 200, 255});
    frame.rgba[4] = 255;
    return frame;
  };
  writeOutput(dir / "a.gif", formatOf(40, 30, 25.0), fixedTimings(30, 25.0), drawn);
  const std::vector<ShownFrame> frames = decodeFrames(dir / "a.gif");
  ASSERT_EQ(frames.size(), 30U);
  for (int k = 0; k < 30; ++k)
    EXPECT_EQ(compareFrames(frames[static_cast<std::size_t>(k)].frame, drawn(k)).worst, 0) << k;
}

TEST(Gif, WhatStandsStillDoesNotCrawl) {
  const TempDir dir;
  // More colours than a palette has, in a part that never changes, beside a part that does.
  const auto drawn = [](int k) {
    Frame frame = noiseFrame(64, 64, 5);
    for (std::size_t i = 0; i < frame.rgba.size(); i += 4) {
      frame.rgba[i + 3] = 255;
      if (i / 4 % 64 < 8) frame.rgba[i] = frame.rgba[i + 1] = static_cast<std::uint8_t>(8 * k);
    }
    return frame;
  };
  writeOutput(dir / "a.gif", formatOf(64, 64, 25.0), fixedTimings(20, 25.0), drawn);
  const std::vector<ShownFrame> frames = decodeFrames(dir / "a.gif");
  ASSERT_EQ(frames.size(), 20U);
  for (const ShownFrame& shown : frames) {
    for (std::size_t i = 0; i < shown.frame.rgba.size(); i += 4) {
      if (i / 4 % 64 < 8) continue;
      ASSERT_TRUE(std::equal(&shown.frame.rgba[i], &shown.frame.rgba[i] + 4, &frames[0].frame.rgba[i]))
          << i / 4;
    }
  }
}

TEST(Gif, AStillClipIsOneFrameThatLasts) {
  const TempDir dir;
  writeOutput(dir / "a.gif", formatOf(16, 12, 1.0), fixedTimings(700, 1.0), [](int) {
    return flatFrame(16, 12, {1, 2, 3, 255});
  });
  const std::vector<ShownFrame> frames = decodeFrames(dir / "a.gif");
  EXPECT_EQ(frames.size(), 2U); // a frame lasts at most 655 s
  EXPECT_NEAR(frames.back().start + frames.back().duration, 700.0, 1e-9);
}

TEST(Apng, VariableRateFollowsTheRecordingToTheMillisecond) {
  const TempDir dir;
  const std::vector<FrameTiming> timings =
      timingsOf({16700000, 100000, 300000, 33000000, 250000000, 16000000});
  writeOutput(dir / "a.apng", formatOf(40, 30, 0.0), timings);
  const std::vector<ShownFrame> frames = decodeFrames(dir / "a.apng");
  ASSERT_EQ(frames.size(), 4U); // two are never seen
  EXPECT_NEAR(frames[1].start, 0.017, 1e-6);
  EXPECT_NEAR(frames[2].start, 0.050, 1e-6);
  EXPECT_NEAR(frames[3].start, 0.300, 1e-6);
  EXPECT_EQ(compareFrames(frames[1].frame, lectureFrame(40, 30, 3)).worst, 0);
}

TEST(Apng, AFrameMayLastLong) {
  const TempDir dir;
  writeOutput(dir / "a.apng", formatOf(40, 30, 0.0),
              timingsOf({65535000000, 65536000000, 700123000000, 20000000}));
  const std::vector<ShownFrame> frames = decodeFrames(dir / "a.apng");
  ASSERT_EQ(frames.size(), 4U);
  EXPECT_NEAR(frames[1].start, 65.535, 1e-6);  // in thousandths of a second
  EXPECT_NEAR(frames[2].start, 131.075, 1e-6); // 65.54 s later: in hundredths
  EXPECT_NEAR(frames[3].start, 831.175, 1e-6); // 700.1 s later: in tenths
}

TEST(Quality, EachLevelIsCloserToTheFramesAndHasALargerFile) {
  const TempDir dir;
  double worse = 255.0;
  std::int64_t smaller = 0;
  for (const Quality quality : {Quality::Draft, Quality::Good, Quality::High}) {
    SinkFormat format = formatOf(320, 240, 30.0);
    format.quality = quality;
    const std::filesystem::path file = dir / (std::string(qualityName(quality)) + ".mp4");
    const std::int64_t bytes = writeOutput(file, format, fixedTimings(kFrames, 30.0)).bytes;
    double mean = 0.0;
    int k = 0;
    for (const ShownFrame& shown : decodeFrames(file))
      mean += compareFrames(shown.frame, lectureFrame(320, 240, k++)).mean / kFrames;
    EXPECT_EQ(k, kFrames);
    EXPECT_LT(mean, worse) << qualityName(quality);
    EXPECT_GT(bytes, smaller) << qualityName(quality);
    worse = mean;
    smaller = bytes;
  }
}

TEST(Joining, TellsHowFarItIsAndEndsWithWhatItsWatchThrows) {
  for (const std::string name : {"x.mp4", "x.webm", "x.gif", "x.apng", "x%d.png"}) {
    const TempDir dir;
    const SinkFormat format = formatOf(32, 24, 30.0);
    std::int64_t most = 0;
    const auto countTo = [&most](std::int64_t joined) { most = std::max(most, joined); };
    writeOutput(dir / name, format, fixedTimings(kFrames, 30.0), {}, countTo);
    EXPECT_EQ(most, kFrames) << name;

    if (name == "x%d.png") continue; // whose pictures stand there before
    writeFile(dir / name, "precious");
    const std::string error = errorOf([&] {
      writeOutput(dir / name, format, fixedTimings(kFrames, 30.0), {}, [](std::int64_t joined) {
        if (joined > kFrames / 2) throw Error(ExitCode::Interrupted, "enough");
      });
    });
    EXPECT_EQ(error, "130: enough") << name;
    EXPECT_EQ(readFile(dir / name), "precious") << name;
    EXPECT_EQ(dir.names().size(), 1U) << name;
  }
}

} // namespace
} // namespace offstage::test
