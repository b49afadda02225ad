// What stands beside the pictures of a video, read back from the finished file with FFmpeg's libraries.

#include "render/output/captions.h"
#include "tests/support/process.h"
#include "tests/support/temp_dir.h"
#include "tests/support/track_decode.h"

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::int64_t kMs = 1000000;
constexpr const char* kCaptionScene = R"(title = "Falling"
duration = 3
[frame]
size = [64, 48]
[world]
gravity = [0, 0]
[walls]
bottom = 0.5
[[body]]
name = "ball"
center = [32, 8]
radius = 4
velocity = [0, 36]
[[section]]
title = "Fall"
start = 0.5
[[section]]
title = "Ünïted <&> 統計"
start = 2
[[caption]]
text = "let go\nx < 3 & y --> z"
from = 0
to = 1.25
[[caption]]
text = "ball hits the floor"
on = "bounce"
body = "ball"
for = 0.5
limit = 1
)";
/// The ball reaches y = 44 after exactly one second.
constexpr std::int64_t kBounce = 1000;

const std::vector<std::string> kContainers{".mp4", ".mov", ".mkv", ".webm"};

bool isMov(const std::string& ending) {
  return ending == ".mp4" || ending == ".mov";
}

void expectNear(const Cue& found, std::int64_t start, std::int64_t end, const std::string& text) {
  EXPECT_NEAR(static_cast<double>(found.start) / kMs, static_cast<double>(start), 1.0);
  EXPECT_NEAR(static_cast<double>(found.end) / kMs, static_cast<double>(end), 1.0);
  EXPECT_EQ(found.text, text);
}

TEST(Tracks, CaptionsAndChaptersStandInEveryContainer) {
  const TempDir dir;
  const std::string scene = dir.write("scene.toml", kCaptionScene).string();
  for (const std::string& ending : kContainers) {
    SCOPED_TRACE(ending);
    const std::string out = (dir / ("x" + ending)).string();
    ASSERT_EQ(offstage({"render", scene, "-o", out, "--jobs", "1"}).status, 0);
    const DecodedTracks tracks = decodeTracks(out);
    ASSERT_EQ(tracks.chapters.size(), 3U);
    EXPECT_EQ(tracks.chapters[0].title, "Falling");
    EXPECT_EQ(tracks.chapters[1].title, "Fall");
    EXPECT_EQ(tracks.chapters[1].start, 500 * kMs);
    EXPECT_EQ(tracks.chapters[2].title, "Ünïted <&> 統計");
    EXPECT_EQ(tracks.chapters[2].end, 3000 * kMs);
    EXPECT_EQ(tracks.codecs[1], isMov(ending) ? "mov_text" : "webvtt");
    if (isMov(ending)) { // shows one text at a time
      ASSERT_EQ(tracks.captions.size(), 3U);
      expectNear(tracks.captions[0], 0, kBounce, "let go\nx < 3 & y --> z");
      expectNear(tracks.captions[1], kBounce, 1250, "let go\nx < 3 & y --> z\nball hits the floor");
      expectNear(tracks.captions[2], 1250, kBounce + 500, "ball hits the floor");
    } else {
      ASSERT_EQ(tracks.captions.size(), 2U);
      expectNear(tracks.captions[0], 0, 1250, "let go\nx &lt; 3 &amp; y --&gt; z");
      expectNear(tracks.captions[1], kBounce, kBounce + 500, "ball hits the floor");
    }
    EXPECT_EQ(readFile(dir / "x.vtt"), "WEBVTT\n\nNOTE made by Offstage\n"
                                       "\n00:00:00.000 --> 00:00:01.250\nlet go\nx &lt; 3 &amp; y --&gt; z\n"
                                       "\n00:00:01.000 --> 00:00:01.500\nball hits the floor\n");
  }
}

TEST(Tracks, APartOfTheVideoHasItsPartOfThem) {
  const TempDir dir;
  const std::string scene = dir.write("scene.toml", kCaptionScene).string();
  ASSERT_EQ(
      offstage({"render", scene, "-o", (dir / "x.mkv").string(), "--from", "1.2", "--to", "2.5"}).status, 0);
  const DecodedTracks tracks = decodeTracks(dir / "x.mkv");
  ASSERT_EQ(tracks.captions.size(), 2U);
  expectNear(tracks.captions[0], 0, 50, "let go\nx &lt; 3 &amp; y --&gt; z");
  expectNear(tracks.captions[1], 0, 300, "ball hits the floor");
  ASSERT_EQ(tracks.chapters.size(), 2U);
  EXPECT_EQ(tracks.chapters[0].title, "Fall");
  EXPECT_EQ(tracks.chapters[0].start, 0);
  EXPECT_EQ(tracks.chapters[1].start, 800 * kMs);
}

TEST(Tracks, NoCaptionOutlastsThePictures) {
  const TempDir dir;
  const std::string scene = dir.write("scene.toml", kCaptionScene).string();
  for (const std::string& ending : kContainers) {
    SCOPED_TRACE(ending);
    const std::string out = (dir / ("x" + ending)).string();
    // One frame, 16.7 ms.
    ASSERT_EQ(offstage({"render", scene, "-o", out, "--from", "1", "--to", "1.001"}).status, 0);
    for (const Cue& cue : decodeTracks(out).captions) EXPECT_LE(cue.end, 16 * kMs);
  }
}

TEST(Tracks, BytesDoNotDependOnTheWorkersAndSegmentsHaveThem) {
  const TempDir dir;
  std::string text = kCaptionScene;
  text += "[sound]\nclicks = true\nloudest = 40\n";
  const std::string scene = dir.write("scene.toml", text).string();
  const auto render = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> command{"render", scene, "-o", (dir / name).string()};
    command.insert(command.end(), more.begin(), more.end());
    const ProcessResult result = offstage(command);
    EXPECT_EQ(result.status, 0) << result.err;
  };
  render("a.mp4", {"--jobs", "0"});
  render("b.mp4", {"--jobs", "3"});
  render("c.mp4", {"--segment", "1/2"});
  render("c.mp4", {"--segment", "2/2"});
  EXPECT_FALSE(std::filesystem::exists(dir / "c.vtt"));
  ASSERT_EQ(offstage({"join", "-o", (dir / "c.mp4").string(), scene}).status, 0);
  EXPECT_EQ(readFile(dir / "a.mp4"), readFile(dir / "b.mp4"));
  EXPECT_EQ(readFile(dir / "a.mp4"), readFile(dir / "c.mp4"));
  EXPECT_EQ(readFile(dir / "a.vtt"), readFile(dir / "c.vtt"));
}

TEST(Tracks, ASidecarThatSomebodyElseWroteIsNeverReplaced) {
  const TempDir dir;
  const std::string scene = dir.write("scene.toml", kCaptionScene).string();
  const std::filesystem::path mine = dir.write("x.vtt", "WEBVTT\n\nmine");
  const ProcessResult result = offstage({"render", scene, "-o", (dir / "x.mp4").string()});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("x.vtt', but a file is there that offstage has not made: move it away"));
  EXPECT_EQ(readFile(mine), "WEBVTT\n\nmine");
  EXPECT_FALSE(std::filesystem::exists(dir / "x.mp4"));
}

TEST(Tracks, ASidecarGoesWithTheCaptions) {
  const TempDir dir;
  const std::string with = dir.write("with.toml", kCaptionScene).string();
  const std::string without =
      dir.write("without.toml", "duration = 0.1\n[frame]\nsize = [32, 32]\n").string();
  const auto render = [&](const std::string& scene, const std::string& name,
                          std::vector<std::string> more = {}) {
    std::vector<std::string> command{"render", scene, "-o", (dir / name).string(), "--duration", "0.1"};
    command.insert(command.end(), more.begin(), more.end());
    const ProcessResult result = offstage(command);
    EXPECT_EQ(result.status, 0) << result.err;
  };
  for (const std::string name : {"x.mp4", "x.gif"}) {
    render(with, name);
    ASSERT_TRUE(std::filesystem::exists(dir / "x.vtt")) << name;
    render(without, name, {"--segment", "1/1"});
    EXPECT_TRUE(std::filesystem::exists(dir / "x.vtt")) << name << ": the old video is still there";
    ASSERT_EQ(offstage({"join", "-o", (dir / name).string(), without}).status, 0);
    EXPECT_FALSE(std::filesystem::exists(dir / "x.vtt")) << name;
  }
  render(with, "x.mp4");
  const std::string made = readFile(dir / "x.vtt");
  render(without, "y.mp4"); // of another name
  EXPECT_EQ(readFile(dir / "x.vtt"), made);
  render(without, "x.mp4");
  EXPECT_FALSE(std::filesystem::exists(dir / "x.vtt"));

  dir.write("x.vtt", "WEBVTT\n\nmine");
  dir.write("mine.vtt", made);
  std::filesystem::create_symlink("mine.vtt", dir / "y.vtt");
  render(without, "x.mp4");
  render(without, "y.mp4");
  EXPECT_EQ(readFile(dir / "x.vtt"), "WEBVTT\n\nmine");
  EXPECT_TRUE(std::filesystem::is_symlink(dir / "y.vtt"));
  EXPECT_EQ(readFile(dir / "mine.vtt"), made);
}

TEST(Tracks, ManyHugeAndTinyCaptionsAreHeld) {
  const TempDir dir;
  std::string text = "duration = 1\n[frame]\nsize = [32, 32]\n";
  const auto add = [&text](const std::string& words, double from, double to) {
    text += "[[caption]]\ntext = \"" + words + "\"\nfrom = " + std::to_string(from) +
            "\nto = " + std::to_string(to) + "\n";
  };
  for (int i = 0; i < 40; ++i)
    add(std::string(1999, static_cast<char>('a' + i % 26)), 0.0, 1.0); // 80 kB at once
  for (int i = 0; i < 300; ++i) add("tiny", 0.2 + i * 0.000999, 0.2 + i * 0.000999 + 0.0009996);
  const std::string scene = dir.write("scene.toml", text).string();
  for (const char* name : {"x.mp4", "x.mkv"}) {
    const ProcessResult result = offstage({"render", scene, "-o", (dir / name).string()});
    EXPECT_EQ(result.status, 0) << result.err;
  }
  EXPECT_GT(decodeTracks(dir / "x.mkv").captions.size(), 300U);
}

TEST(Tracks, AReplayHasNoEventsToShow) {
  const TempDir dir;
  dir.write("t.csv", "frame,time,id,x,y,radius\n0,0,0,1,2,3\n1,1,0,1,2,3\n");
  const std::string scene = dir.write("scene.toml", "[replay]\ntrace = \"t.csv\"\n[sound]\nclicks = true\n"
                                                    "[[caption]]\ntext = \"x\"\non = \"bounce\"\n")
                                .string();
  const ProcessResult result = offstage({"check", scene});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("'sound' with clicks needs events, but a [replay] simulates nothing"));
  EXPECT_THAT(result.err, HasSubstr("'caption' with 'on' needs events, but a [replay] simulates nothing"));
}

TEST(Tracks, AnimationsHaveTheSidecarAndPicturesHaveNone) {
  const TempDir dir;
  const std::string scene = dir.write("scene.toml", kCaptionScene).string();
  ASSERT_EQ(offstage({"render", scene, "-o", (dir / "x.gif").string()}).status, 0);
  EXPECT_TRUE(std::filesystem::exists(dir / "x.vtt"));
  std::filesystem::create_directory(dir / "f");
  ASSERT_EQ(offstage({"render", scene, "-o", (dir / "f/%03d.png").string(), "--to", "0.05"}).status, 0);
  EXPECT_THAT(dir.names("f"), ElementsAre("000.png", "001.png", "002.png"));
}

TEST(Tracks, WhatAnOutputCannotHoldIsToldInOneLine) {
  const TempDir dir;
  const std::string all =
      dir.write("all.toml", std::string(kCaptionScene) + "[sound]\nclicks = true\n").string();
  const std::string captions =
      dir.write("captions.toml", "duration = 1\n[frame]\nsize = [32, 32]\n[[caption]]\n"
                                 "text = \"a\"\nfrom = 0\nto = 1\n")
          .string();
  const auto told = [&](const std::string& scene, const std::string& name) {
    const ProcessResult result =
        offstage({"render", scene, "-o", (dir / name).string(), "--to", "0.1", "--fps", "50"});
    EXPECT_EQ(result.status, 0) << name;
    return result.err;
  };
  EXPECT_EQ(told(all, "x.mkv"), "");
  EXPECT_EQ(told(all, "x.gif"), "offstage: 'x.gif' holds no sound or chapters\n");
  EXPECT_EQ(told(all, "x.apng"), "offstage: 'x.apng' holds no sound or chapters\n");
  EXPECT_EQ(told(all, "x%d.png"), "offstage: 'x%d.png' holds no sound, captions or chapters\n");
  EXPECT_EQ(told(all, "x.raw"), "offstage: 'x.raw' holds no sound, captions or chapters\n");
  EXPECT_EQ(told(captions, "x.raw"), "offstage: 'x.raw' holds no captions\n");
  EXPECT_EQ(told(captions, "x.gif"), "") << "they are in x.vtt";
}

/// A ball that flies between two walls: it starts 120 px from the right one at 100 px/s, and is back after 2
/// · 140 px.
constexpr const char* kClickScene = R"(duration = 4.5
[frame]
size = [160, 60]
[world]
gravity = [0, 0]
[walls]
all = 1
[[body]]
center = [30, 30]
radius = 10
velocity = [100, 0]
[sound]
clicks = true
loudest = 200
)";

TEST(Sound, AClickIsWithinTenMillisecondsOfItsContact) {
  const TempDir dir;
  const std::string scene = dir.write("scene.toml", kClickScene).string();
  for (const std::string& ending : kContainers) {
    SCOPED_TRACE(ending);
    const std::string out = (dir / ("x" + ending)).string();
    ASSERT_EQ(offstage({"render", scene, "-o", out}).status, 0);
    const DecodedTracks tracks = decodeTracks(out);
    EXPECT_EQ(tracks.soundCodec, isMov(ending) ? "aac" : "opus");
    EXPECT_EQ(tracks.soundRate, 48000);
    EXPECT_EQ(tracks.soundChannels, 2);
    EXPECT_NEAR(static_cast<double>(tracks.sound.size()) / 48000.0, 4.5, 0.025);
    EXPECT_NEAR(onset(tracks, 0.0, 0.03F), 1.2, 0.010);
    EXPECT_NEAR(onset(tracks, 1.5, 0.03F), 2.6, 0.010);
    EXPECT_NEAR(onset(tracks, 3.0, 0.03F), 4.0, 0.010);
  }
}

TEST(Sound, ClicksFollowTheVideosTimeAndTheClosingSpeed) {
  const TempDir dir;
  std::string text = kClickScene;
  text += "[[pause]]\nat = 0.5\nfor = 1\n[[speed]]\nfrom = 1\nto = 2\nfactor = 0.5\n";
  const std::string scene = dir.write("scene.toml", text).string();
  ASSERT_EQ(offstage({"render", scene, "-o", (dir / "x.mp4").string()}).status, 0);
  const DecodedTracks tracks = decodeTracks(dir / "x.mp4");
  EXPECT_NEAR(onset(tracks, 0.0, 0.03F), 2.4, 0.010); // 1 s pause; 0.2 s of slow motion take 0.4 s
  EXPECT_NEAR(onset(tracks, 2.7, 0.03F), 4.6, 0.010);
  const auto loudest = [](const DecodedTracks& decoded) {
    float peak = 0.0F;
    for (const float sample : decoded.sound) peak = std::max(peak, std::abs(sample));
    return peak;
  };
  const std::string faster = text.replace(text.find("loudest = 200"), 13, "loudest = 100");
  ASSERT_EQ(
      offstage({"render", dir.write("fast.toml", faster).string(), "-o", (dir / "y.mp4").string()}).status,
      0);
  EXPECT_GT(loudest(decodeTracks(dir / "y.mp4")), 1.4F * loudest(tracks)); // (0.15+0.85)/(0.15+0.425)
}

TEST(Sound, AClickDoesNotDependOnTheSteps) {
  const TempDir dir;
  struct Case {
    const char* clock;
    double contact; ///< s of the video: the first one
  };
  const std::vector<Case> cases{
      {"fps = 7\n", 1.2},
      {"fps = 7\nsubsteps = 10\n", 1.2},
      {"fps = 20\nstep = \"clamped\"\ndt = 0.03\n", 1.2},
      // A step of 1/60 s a frame: the world is half as fast as the video's 30 frames a second.
      {"fps = 30\nstep = \"fixed\"\n", 2.4},
      // Pictures of an accumulator show the state of one step ago.
      {"fps = 60\nstep = \"accumulator\"\ndt = 0.1\n", 1.3},
  };
  for (const Case& made : cases) {
    const std::string scene =
        dir.write("scene.toml", std::string(kClickScene) + "[clock]\n" + made.clock).string();
    ASSERT_EQ(offstage({"render", scene, "-o", (dir / "x.mp4").string()}).status, 0) << made.clock;
    EXPECT_NEAR(onset(decodeTracks(dir / "x.mp4"), 0.0, 0.03F), made.contact, 0.010) << made.clock;
  }
}

TEST(Sound, ASectionLastsAsLongAsItsNarration) {
  const TempDir dir;
  writeWav(dir / "a.wav", tone(440, 2.0, 0.05, 22050), 22050);
  writeWav(dir / "b.wav", tone(660, 0.5, 0.05, 48000), 48000);
  const std::string scene =
      dir.write("scene.toml",
                "duration = 2\n[frame]\nsize = [64, 48]\n[[section]]\ntitle = \"A\"\nstart = 0\n"
                "narration = \"a.wav\"\n[[section]]\ntitle = \"B\"\nstart = 1\nnarration = \"b.wav\"\n")
          .string();
  ASSERT_EQ(offstage({"render", scene, "-o", (dir / "x.mp4").string()}).status, 0);
  const DecodedTracks tracks = decodeTracks(dir / "x.mp4");
  ASSERT_EQ(tracks.chapters.size(), 2U);
  EXPECT_EQ(tracks.chapters[1].start, 2000 * kMs);
  EXPECT_EQ(tracks.chapters[1].end, 3000 * kMs);
  EXPECT_NEAR(static_cast<double>(tracks.sound.size()) / 48000.0, 3.0, 0.025);
  EXPECT_LT(onset(tracks, 0.0, 0.05F), 0.010);
  EXPECT_NEAR(onset(tracks, 2.51, 0.05F), -1.0, 0.0); // silent after b's half second
}

/// The C library has its mathematics twice, with and without fused multiply-add, and chooses by the
/// processor; their doubles differ in last bits. The sound's bytes do not.
TEST(Sound, BytesDoNotDependOnTheProcessorsMathematics) {
  const TempDir dir;
  writeWav(dir / "a.wav", tone(440, 1.5, 0.05, 22050), 22050);
  writeWav(dir / "b.wav", tone(1234.5, 1.0, 0.6, 44100), 44100);
  const std::string scene =
      dir.write("scene.toml", std::string(kClickScene) +
                                  "[[section]]\ntitle = \"A\"\nstart = 0\nnarration = \"a.wav\"\n"
                                  "[[section]]\ntitle = \"B\"\nstart = 2\nnarration = \"b.wav\"\n")
          .string();
  ProcessOptions older;
  older.environment = {{"GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX512F,-AVX2,-FMA,-FMA4,-AVX,-SSE4_1"}};
  for (const std::string& ending : kContainers) {
    const std::string one = (dir / ("one" + ending)).string();
    const std::string two = (dir / ("two" + ending)).string();
    ASSERT_EQ(offstage({"render", scene, "-o", one}).status, 0);
    ASSERT_EQ(offstage({"render", scene, "-o", two}, older).status, 0);
    EXPECT_EQ(readFile(one), readFile(two)) << ending;
  }
}

TEST(Sound, UnreadableNarrationIsALocatedError) {
  const TempDir dir;
  dir.write("noise.mp3", "this is no sound at all");
  dir.write("empty.wav", "");
  writeWav(dir / "none.wav", {}, 48000);
  for (const char* file : {"noise.mp3", "empty.wav", "none.wav"}) {
    const std::string scene =
        dir.write("scene.toml", "duration = 1\n[narration]\nfile = \"" + std::string(file) + "\"\n").string();
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"render", scene, "-o", (dir / "x.mp4").string()}, {"check", scene}}) {
      const ProcessResult result = offstage(command);
      EXPECT_EQ(result.status, 2) << file;
      EXPECT_THAT(result.err, HasSubstr("scene.toml:3:8: error: 'file' in [narration] names the file"));
      EXPECT_THAT(result.err, HasSubstr(file));
    }
    EXPECT_FALSE(std::filesystem::exists(dir / "x.mp4"));
  }
}

TEST(Sound, AChangedNarrationStartsARenderOver) {
  const TempDir dir;
  writeWav(dir / "a.wav", tone(440, 1.0, 0.1, 48000), 48000);
  const std::string scene =
      dir.write("scene.toml", "duration = 1\n[frame]\nsize = [64, 48]\n[narration]\nfile = \"a.wav\"\n")
          .string();
  const std::string out = (dir / "x.mp4").string();
  ASSERT_EQ(offstage({"render", scene, "-o", out, "--segment", "1/1"}).status, 0);
  writeWav(dir / "a.wav", tone(880, 1.0, 0.1, 48000), 48000);
  const ProcessResult joined = offstage({"join", "-o", out, scene});
  EXPECT_EQ(joined.status, 2);
  EXPECT_THAT(joined.err, HasSubstr("were made from something else, which differs in the scene"));
}

} // namespace
} // namespace offstage::test
