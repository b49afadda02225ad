#include "render/output/chunk_plan.h"
#include "render/output/chunked_output.h"
#include "render/output/input_file.h"
#include "render/output/libav.h"
#include "render/output/packet_hash.h"
#include "render/output/verify.h"
#include "tests/support/child.h"
#include "tests/support/output_writer.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"
#include "tests/support/video_decode.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

namespace fs = std::filesystem;
using test::DecodedVideo;
using test::decodeVideo;
using test::errorOf;
using test::fixedTimings;
using test::flatFrame;
using test::formatOf;
using test::lectureFrame;
using test::TempDir;
using test::timingsOf;
using test::writeOutput;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr std::array<const char*, 3> kNames{"a.mp4", "a.mov", "a.mkv"};

/// A main loop's log: about 60 frames a second, never quite, and one hiccup.
std::vector<std::int64_t> recordedDurations(int frames, int hiccupAt) {
  std::vector<std::int64_t> durations;
  durations.reserve(static_cast<std::size_t>(frames));
  for (int k = 0; k < frames; ++k)
    durations.push_back(k == hiccupAt ? 250000000 : 16666667 + (k * 7919 % 997 - 498) * 1000);
  return durations;
}

void writeFixed(const fs::path& out, const SinkFormat& format, int frames) {
  writeOutput(out, format, fixedTimings(frames, format.fps));
}

TEST(Video, IsWhatPlayersExpectInEveryContainer) {
  const TempDir dir;
  SinkFormat format = formatOf(160, 120, 60.0);
  format.title = "Übung 2: Bälle";
  for (const char* name : kNames) {
    writeFixed(dir / name, format, 45);
    const DecodedVideo video = decodeVideo(dir / name);
    EXPECT_EQ(video.codec, "h264") << name;
    EXPECT_EQ(video.profile, "High") << name;
    EXPECT_EQ(video.pixelFormat, "yuv420p") << name;
    EXPECT_EQ(video.primaries, "bt709") << name;
    EXPECT_EQ(video.transfer, "bt709") << name;
    EXPECT_EQ(video.matrix, "bt709") << name;
    EXPECT_EQ(video.range, "tv") << name;
    EXPECT_EQ(video.chromaLocation, "left") << name;
    EXPECT_EQ(video.title, format.title) << name;
    EXPECT_EQ(video.width, 160) << name;
    EXPECT_EQ(video.height, 120) << name;
    EXPECT_EQ(video.pictures.size(), 45U) << name;
    EXPECT_NEAR(video.averageRate, 60.0, 1e-9) << name;
    EXPECT_EQ(video.duration, 750000000) << name;
  }
}

TEST(Video, IndexStandsBeforeThePictures) {
  const TempDir dir;
  for (const char* name : {"a.mp4", "a.mov"}) {
    writeFixed(dir / name, formatOf(64, 48, 60.0), 10);
    std::vector<std::string> boxes = test::topLevelBoxes(dir / name);
    const auto moov = std::find(boxes.begin(), boxes.end(), "moov");
    const auto mdat = std::find(boxes.begin(), boxes.end(), "mdat");
    ASSERT_NE(moov, boxes.end());
    ASSERT_NE(mdat, boxes.end());
    EXPECT_LT(moov, mdat) << name << ": " << testing::PrintToString(boxes);
  }
}

TEST(Video, FixedRateShowsFrameKAtKOverFps) {
  const TempDir dir;
  for (const double fps : {24.0, 60.0, 29.97, 60000.0 / 1001.0, 12.5, 0.5, 240.0}) {
    for (const char* name : kNames) {
      writeFixed(dir / name, formatOf(32, 24, fps), 12);
      const DecodedVideo video = decodeVideo(dir / name);
      ASSERT_EQ(video.pictures.size(), 12U) << name << ' ' << fps;
      const bool millisecond = std::string(name) == "a.mkv";
      for (std::size_t k = 0; k < 12; ++k) {
        EXPECT_NEAR(static_cast<double>(video.pictures[k].start), static_cast<double>(k) / fps * 1e9,
                    millisecond ? 5.1e5 : 1.0)
            << name << ' ' << fps << " frame " << k;
      }
      // libavformat states the duration in whole microseconds.
      EXPECT_NEAR(static_cast<double>(video.duration), 12.0 / fps * 1e9, millisecond ? 5.1e5 : 1001.0)
          << name << ' ' << fps;
      EXPECT_NEAR(video.averageRate, fps, 1e-5 * fps) << name;
    }
  }
}

TEST(Video, VariableRateFollowsTheRecordingToItsEnd) {
  const TempDir dir;
  for (const int hiccup : {0, 1, 20, 38, 39}) { // 40 frames: the hiccup is also the first and the last
    const std::vector<FrameTiming> timings = timingsOf(recordedDurations(40, hiccup));
    for (const char* name : kNames) {
      writeOutput(dir / name, formatOf(64, 48, 0.0), timings);
      const DecodedVideo video = decodeVideo(dir / name);
      const double tick = std::string(name) == "a.mkv" ? 1e6 : 1e3;
      ASSERT_EQ(video.pictures.size(), timings.size()) << name << ", hiccup " << hiccup;
      EXPECT_EQ(video.pictures[0].start, 0) << name << ", hiccup " << hiccup;
      for (std::size_t k = 0; k < timings.size(); ++k) {
        EXPECT_NEAR(static_cast<double>(video.pictures[k].start), static_cast<double>(timings[k].start),
                    tick / 2)
            << name << ", hiccup " << hiccup << ", frame " << k;
      }
      const auto end = static_cast<double>(timings.back().end);
      EXPECT_NEAR(static_cast<double>(video.duration), end, tick / 2) << name << ", hiccup " << hiccup;
      if (video.streamDuration >= 0) {
        EXPECT_NEAR(static_cast<double>(video.streamDuration), end, tick / 2)
            << name << ", hiccup " << hiccup;
      }
      // .mkv holds no decoding times.
      for (std::size_t k = 1; std::string(name) != "a.mkv" && k < video.decodeTimes.size(); ++k) {
        ASSERT_LT(video.decodeTimes[k - 1], video.decodeTimes[k]) << name << ", packet " << k;
      }
    }
  }
}

TEST(Video, FrameThatIsNeverSeenGivesWayToTheNext) {
  const TempDir dir;
  // Frames 2 and 3 begin in the same microsecond as frame 4; frame 6, the last, lasts no time at all.
  const std::vector<FrameTiming> timings = timingsOf({16000000, 16000000, 0, 300, 16000000, 16000000, 0});
  writeOutput(dir / "a.mp4", formatOf(64, 48, 0.0), timings);
  const DecodedVideo video = decodeVideo(dir / "a.mp4");
  ASSERT_EQ(video.pictures.size(), 4U);
  EXPECT_EQ(video.pictures[2].start, 32000000);
  EXPECT_LT(test::meanAbsoluteError(test::toRgb(video, 2), lectureFrame(64, 48, 4)),
            test::meanAbsoluteError(test::toRgb(video, 2), lectureFrame(64, 48, 2)));
  EXPECT_EQ(video.duration, 64000000);
}

TEST(Video, OneFrameIsEnough) {
  const TempDir dir;
  for (const char* name : kNames) {
    writeOutput(dir / name, formatOf(64, 48, 0.0), timingsOf({40000000}));
    const DecodedVideo video = decodeVideo(dir / name);
    ASSERT_EQ(video.pictures.size(), 1U) << name;
    EXPECT_EQ(video.pictures[0].start, 0) << name;
    EXPECT_EQ(video.duration, 40000000) << name;
  }
}

TEST(Video, ChunksJoinWithoutASeam) {
  const TempDir dir;
  const int frames = 485;
  const ChunkPlan plan(frames);
  ASSERT_EQ(plan.chunks(), 4);
  std::vector<bool> begins(frames, false);
  for (std::int64_t chunk = 0; chunk < plan.chunks(); ++chunk)
    begins[static_cast<std::size_t>(plan.begin(chunk))] = true;
  for (const double fps : {60.0, 0.0}) {
    const std::vector<FrameTiming> timings =
        fps > 0.0 ? fixedTimings(frames, fps)
                  : timingsOf(recordedDurations(frames, static_cast<int>(plan.begin(1))));
    writeOutput(dir / "a.mp4", formatOf(160, 120, fps), timings);
    const DecodedVideo video = decodeVideo(dir / "a.mp4");
    ASSERT_EQ(video.pictures.size(), timings.size());
    for (std::size_t k = 0; k < timings.size(); ++k) {
      EXPECT_NEAR(static_cast<double>(video.pictures[k].start), static_cast<double>(timings[k].start), 501.0)
          << "frame " << k;
      EXPECT_TRUE(video.pictures[k].keyFrame || !begins[k]) << "frame " << k;
      if (!begins[k] && (k + 1 == timings.size() || !begins[k + 1])) continue;
      EXPECT_LT(test::meanAbsoluteError(test::toRgb(video, k), lectureFrame(160, 120, static_cast<int>(k))),
                2.0)
          << k;
    }
  }
}

TEST(Video, DecodedFramesMatchTheDrawnOnes) {
  const TempDir dir;
  writeFixed(dir / "a.mp4", formatOf(320, 240, 60.0), 60);
  const DecodedVideo video = decodeVideo(dir / "a.mp4");
  ASSERT_EQ(video.pictures.size(), 60U);
  double worst = 0.0;
  for (int k = 0; k < 60; ++k) {
    worst = std::max(worst, test::meanAbsoluteError(test::toRgb(video, static_cast<std::size_t>(k)),
                                                    lectureFrame(320, 240, k)));
  }
  // Half of this is 4:2:0 itself, whose halved chroma blurs coloured edges.
  EXPECT_LT(worst, 1.0);
  RecordProperty("worst", fmt::format("{:.3f}", worst));
}

TEST(Video, SaturatedColoursAreNotShifted) {
  const TempDir dir;
  const std::array<std::array<std::uint8_t, 4>, 6> colors{{{255, 0, 0, 255},
                                                           {0, 255, 0, 255},
                                                           {0, 0, 255, 255},
                                                           {255, 255, 255, 255},
                                                           {0, 0, 0, 255},
                                                           {128, 128, 128, 255}}};
  for (const auto& color : colors) {
    writeOutput(dir / "a.mp4", formatOf(64, 48, 30.0), fixedTimings(5, 30.0),
                [&](int) { return flatFrame(64, 48, color); });
    const Frame decoded = test::toRgb(decodeVideo(dir / "a.mp4"), 4);
    int worst = 0;
    for (std::size_t i = 0; i < decoded.rgba.size(); ++i)
      worst = std::max(worst, std::abs(decoded.rgba[i] - color[i % 4]));
    EXPECT_LE(worst, 2) << fmt::format("{} {} {}", color[0], color[1], color[2]);
  }
}

TEST(Video, OddSizesArePaddedAndItSaysSo) {
  const TempDir dir;
  EXPECT_EQ(makeChunkedOutput(dir / "a.mp4", formatOf(641, 33, 30.0))->notice(),
            "width 641 is odd: padded to 642 by repeating the last column\n"
            "height 33 is odd: padded to 34 by repeating the last row");
  EXPECT_EQ(makeChunkedOutput(dir / "b.mp4", formatOf(640, 33, 30.0))->notice(),
            "height 33 is odd: padded to 34 by repeating the last row");
  EXPECT_EQ(makeChunkedOutput(dir / "b.mp4", formatOf(640, 32, 30.0))->notice(), "");
  writeFixed(dir / "a.mp4", formatOf(641, 33, 30.0), 1);
  const DecodedVideo video = decodeVideo(dir / "a.mp4");
  EXPECT_EQ(video.width, 642);
  EXPECT_EQ(video.height, 34);
  const std::vector<std::uint8_t>& luma = video.pictures.at(0).y;
  for (std::size_t row = 0; row < 34; ++row) {
    EXPECT_NEAR(luma[row * 642 + 641], luma[row * 642 + 640], 8) << "row " << row;
  }
  writeFixed(dir / "tiny.mkv", formatOf(1, 1, 30.0), 3);
  EXPECT_EQ(decodeVideo(dir / "tiny.mkv").width, 2);
}

TEST(Video, SameFramesGiveTheSameBytes) {
  const TempDir dir;
  for (const char* ending : {"mp4", "mov", "mkv"}) {
    for (const double fps : {60.0, 0.0}) {
      SinkFormat format = formatOf(64, 48, fps);
      format.title = "twice";
      const std::vector<FrameTiming> timings = timingsOf(recordedDurations(30, 9));
      const fs::path first = dir / fmt::format("first.{}", ending);
      const fs::path second = dir / fmt::format("another-name.{}", ending);
      writeOutput(first, format, timings);
      writeOutput(second, format, timings);
      EXPECT_TRUE(test::readFile(first) == test::readFile(second)) << ending << ' ' << fps;
    }
  }
}

TEST(Video, NamesThatLookLikeProtocolsAreFiles) {
  const TempDir dir;
  for (const char* name : {"http:x.mp4", "a b'ü%d.mkv", "-.mov"}) {
    writeFixed(dir / name, formatOf(32, 24, 30.0), 3);
    EXPECT_EQ(decodeVideo(dir / name).pictures.size(), 3U) << name;
  }
  EXPECT_EQ(dir.names().size(), 3U);
}

TEST(Video, JoinTellsTheFilesSize) {
  const TempDir dir;
  for (const char* name : kNames) {
    const test::Written written = writeOutput(dir / name, formatOf(64, 48, 30.0), fixedTimings(20, 30.0));
    EXPECT_EQ(written.bytes, static_cast<std::int64_t>(fs::file_size(dir / name))) << name;
  }
}

TEST(Video, RefusesFramesOutOfOrder) {
  const TempDir dir;
  const SinkFormat format = formatOf(32, 24, 0.0);
  const Frame frame = lectureFrame(32, 24, 0);
  const auto errorAfter = [&](const std::vector<FrameTiming>& timings, std::int64_t firstFrame = 0) {
    return errorOf([&] {
      const auto output = makeChunkedOutput(dir / "a.mp4", format);
      const auto writer = output->begin(dir / "chunk", firstFrame);
      for (const FrameTiming& timing : timings) writer->write(frame, timing);
    });
  };
  EXPECT_EQ(errorAfter({{1, 0, 10}}), "2: frame 1 came where frame 0 was due");
  EXPECT_EQ(errorAfter({{1, 0, 10}}, 7), "2: frame 1 came where frame 7 was due");
  EXPECT_EQ(errorAfter({{0, 0, 10}, {0, 10, 20}}), "2: frame 0 came where frame 1 was due");
  const std::string order = " ns, which does not follow the frame before it";
  EXPECT_EQ(errorAfter({{0, 10, 5}}), "2: frame 0 is shown from 10 to 5" + order);
  EXPECT_EQ(errorAfter({{0, -10, 5}}), "2: frame 0 is shown from -10 to 5" + order);
  EXPECT_EQ(errorAfter({{0, 0, 5000}, {1, 4000, 9000}}), "2: frame 1 is shown from 4000 to 9000" + order);
  EXPECT_EQ(errorAfter({{0, 0, 5000}, {1, 6000, 9000}}), "2: frame 1 is shown from 6000 to 9000" + order);
  EXPECT_EQ(errorAfter({{0, 0, 3000000000000}}),
            "2: frame 0 lasts 3000 s; a video's frame lasts at most 2147 s");
  EXPECT_EQ(errorOf([&] {
              makeChunkedOutput(dir / "a.mp4", format)
                  ->begin(dir / "chunk", 0)
                  ->write(lectureFrame(24, 32, 0), {0, 0, 1});
            }),
            "2: a frame of 24 × 32 px came to an output of 32 × 24 px");
  EXPECT_THAT(dir.names(), IsEmpty());
}

TEST(Video, WithoutFramesThereIsNone) {
  const TempDir dir;
  for (const char* name : kNames) {
    EXPECT_THAT(errorOf([&] { makeChunkedOutput(dir / name, formatOf(32, 24, 30.0))->join({}, 0); }),
                StartsWith("2: no frames"));
    // Frames that last no time are none.
    EXPECT_THAT(errorOf([&] {
                  writeOutput(dir / name, formatOf(32, 24, 0.0), timingsOf({0, 100, 0}));
                }),
                StartsWith("2: no frames"));
  }
  EXPECT_THAT(dir.names(), IsEmpty());
}

/// Runs `action` in a child whose files may grow to `bytes` only; whether it ends as on a full disk.
bool failsAsOnAFullDisk(rlim_t bytes, const std::function<void()>& action) {
  return test::inChild([&] {
           std::signal(SIGXFSZ, SIG_IGN);
           const rlimit limit{bytes, bytes};
           setrlimit(RLIMIT_FSIZE, &limit);
           const std::string error = errorOf(action);
           return error.starts_with("75: cannot write ") && error.find("largest size") != std::string::npos
                      ? 0
                      : 1;
         }) == 0;
}

TEST(Video, FullDiskIsTransientAndLeavesNothing) {
  const TempDir dir;
  const std::vector<FrameTiming> timings = fixedTimings(40, 30.0);
  for (const char* name : kNames) {
    const SinkFormat format = formatOf(160, 120, 30.0);
    const TempDir chunks;
    const auto output = makeChunkedOutput(dir / name, format);
    const auto makeChunk = [&](const char* chunk) {
      const auto writer = output->begin(chunks / chunk, 0);
      for (int k = 0; k < 40; ++k)
        writer->write(lectureFrame(160, 120, k), timings[static_cast<std::size_t>(k)]);
      writer->finish();
    };
    EXPECT_TRUE(failsAsOnAFullDisk(2000, [&] { makeChunk("a"); })) << name;
    EXPECT_THAT(chunks.names(), IsEmpty()) << name;

    makeChunk("b");
    const std::vector<fs::path> all{chunks / "b"};
    const auto size = static_cast<rlim_t>(output->join(all, 40));
    fs::remove(dir / name);
    for (const rlim_t bytes : {rlim_t{10}, size / 2, size - 10}) // in the header, the pictures, the index
      EXPECT_TRUE(failsAsOnAFullDisk(bytes, [&] { output->join(all, 40); })) << name << ' ' << bytes;
    EXPECT_THAT(dir.names(), IsEmpty()) << name;
  }
}

/// The hash of what a file holds, as it is.
std::uint64_t packetHashOf(const fs::path& file) {
  libav::InputContext format;
  if (libav::openInput(file, format) < 0) throw std::runtime_error("the video does not open");
  const libav::Packet packet = libav::makePacket();
  PacketHash hash;
  for (; av_read_frame(format.get(), packet.get()) >= 0; av_packet_unref(packet.get()))
    hash.addStored(*packet);
  return hash.value();
}

ExpectedVideo expectedOf(const fs::path& whole, int width, int height, int frames, double fps) {
  ExpectedVideo expected;
  expected.packets = packetHashOf(whole);
  expected.width = width;
  expected.height = height;
  expected.frames = frames;
  expected.timeBase = {1, static_cast<int>(fps)};
  expected.lastStart = frames - 1;
  expected.end = frames;
  return expected;
}

TEST(VerifyVideo, NamesEachDifference) {
  const TempDir dir;
  const fs::path file = dir / "a.mp4";
  writeFixed(file, formatOf(64, 48, 30.0), 20);
  const auto verify = [&file](const ExpectedVideo& expected) {
    return errorOf([&] { verifyVideo(file, expected, "out.mp4"); });
  };
  const std::string failed = "75: the check of the finished 'out.mp4' failed: ";
  ExpectedVideo expected = expectedOf(file, 64, 48, 20, 30);
  EXPECT_EQ(verify(expected), "no error");
  expected.frames = 21;
  EXPECT_EQ(verify(expected), failed + "number of frames 20 instead of 21");
  expected = expectedOf(file, 66, 46, 20, 30);
  EXPECT_EQ(verify(expected),
            failed + "width 64 instead of 66; height 48 instead of 46; decoded width 64 instead of 66; "
                     "decoded height 48 instead of 46");
  expected = expectedOf(file, 64, 48, 20, 30);
  expected.end = 21;
  EXPECT_EQ(verify(expected), failed + "duration 0.666667 s instead of 0.700000 s");
  expected.end = 20;
  expected.packets ^= 1U;
  EXPECT_THAT(verify(expected), StartsWith(failed + "hash of the packets "));
  expected.packets ^= 1U;
  expected.lastStart = 18;
  EXPECT_EQ(verify(expected), failed + "start of the last frame 0.633333 s instead of 0.600000 s");
}

TEST(VerifyVideo, FindsTruncatedDamagedAndForeignFiles) {
  const int logLevel = av_log_get_level();
  av_log_set_level(AV_LOG_QUIET); // libav has much to say about such files
  const TempDir dir;
  for (const char* name : {"a.mp4", "a.mkv"}) {
    writeFixed(dir / name, formatOf(64, 48, 30.0), 20);
    const std::string whole = test::readFile(dir / name);
    const auto verify = [&](const std::string& bytes) {
      test::writeFile(dir / "damaged", bytes);
      return errorOf([&] { verifyVideo(dir / "damaged", expectedOf(dir / name, 64, 48, 20, 30), name); });
    };
    EXPECT_EQ(verify(whole), "no error") << name;
    for (std::size_t size = 0; size < whole.size(); size += whole.size() / 7) {
      EXPECT_THAT(verify(whole.substr(0, size)), StartsWith("75: the check of the finished"))
          << name << " cut to " << size;
    }
    std::string damaged = whole;
    std::fill(damaged.end() - 300, damaged.end() - 20, '\xFF');
    EXPECT_THAT(verify(damaged), StartsWith("75: ")) << name << ": bytes before the end overwritten";
    EXPECT_THAT(verify("not a video at all"), StartsWith("75: ")) << name;
  }
  EXPECT_THAT(errorOf([&] { verifyVideo(dir / "none", expectedOf(dir / "a.mp4", 64, 48, 20, 30), "x"); }),
              HasSubstr("cannot be opened"));
  av_log_set_level(logLevel);
}

TEST(VerifyVideo, FindsDamageInEveryFrame) {
  const int logLevel = av_log_get_level();
  av_log_set_level(AV_LOG_QUIET);
  const TempDir dir;
  for (const char* name : {"a.mp4", "a.mkv"}) {
    writeFixed(dir / name, formatOf(160, 120, 30.0), 20);
    const std::string whole = test::readFile(dir / name);
    libav::InputContext format;
    ASSERT_GE(libav::openInput(dir / name, format), 0);
    const libav::Packet packet = libav::makePacket();
    int frames = 0;
    for (; av_read_frame(format.get(), packet.get()) >= 0; av_packet_unref(packet.get())) {
      ++frames;
      const std::string data(packet->data, packet->data + packet->size);
      std::string damaged = whole;
      const std::size_t begin = whole.find(data);
      ASSERT_NE(begin, std::string::npos);
      damaged[begin + data.size() - 1] ^= '\x10';
      test::writeFile(dir / "damaged", damaged);
      EXPECT_THAT(
          errorOf([&] { verifyVideo(dir / "damaged", expectedOf(dir / name, 160, 120, 20, 30), name); }),
          StartsWith("75: "))
          << name << ": the last byte of frame " << frames;
    }
    EXPECT_EQ(frames, 20) << name;
  }
  av_log_set_level(logLevel);
}

TEST(VerifyVideo, DecodesTheLastFrameOfEveryQuality) {
  const TempDir dir;
  for (const Quality quality : {Quality::Draft, Quality::Good, Quality::High, Quality::Lossless}) {
    for (const int frames : {1, 2, 3, 4, 20}) {
      SinkFormat format = formatOf(160, 120, 30.0);
      format.quality = quality;
      const fs::path file = dir / (quality == Quality::Lossless ? "a.mkv" : "a.mp4");
      EXPECT_EQ(errorOf([&] { writeFixed(file, format, frames); }), "no error")
          << frames << " frames of quality " << static_cast<int>(quality);
    }
  }
}

} // namespace
} // namespace offstage
