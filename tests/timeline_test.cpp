// A video whose time is not simply the simulation's: the physics stays as it is, and every way to a frame
// gives the same.

#include "render/draw/camera.h"
#include "render/draw/image.h"
#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kWorld = R"(duration = 3
[frame]
size = [160, 90]
[world]
gravity = [0, 200]
[walls]
all = 0.9
[[body]]
name = "ball"
center = [40, 15]
radius = 8
velocity = [60, 0]
[[body]]
name = "other"
center = [120, 40]
radius = 8
velocity = [-30, 0]
[[collide]]
between = ["bodies", "bodies"]
)";
constexpr const char* kTimeline = R"(
[timeline]
fade_in = 0.2
fade_out = 0.2
[[section]]
title = "A"
start = 0
[[section]]
title = "B"
start = 2
card = 0.5
[[pause]]
at = 0.7
for = 0.5
highlight = ["ball"]
[[pause]]
at = 1.1
for = 0.5
highlight = ["other"]
style = "dim"
[[speed]]
from = 0.5
to = 1
factor = 0.3
[[speed]]
from = 2
factor = 3
[[camera]]
at = 1
for = 0.5
center = "ball"
zoom = 2
[[camera]]
at = 2.5
)";

struct HashLine {
  std::string frame, state, pixels;
};

std::vector<HashLine> readHashes(const std::filesystem::path& file) {
  std::istringstream in(readFile(file));
  std::vector<HashLine> lines;
  for (HashLine line; in >> line.frame >> line.state >> line.pixels;) lines.push_back(line);
  return lines;
}

TEST(Timeline, LeavesThePhysicsAsItIs) {
  const TempDir dir;
  const std::string plain = dir.write("plain.toml", kWorld).string();
  const std::string edited = dir.write("edited.toml", std::string(kWorld) + kTimeline).string();
  ASSERT_EQ(offstage({"render", plain, "--hash", (dir / "plain.txt").string()}).status, 0);
  ASSERT_EQ(offstage({"render", edited, "--hash", (dir / "edited.txt").string()}).status, 0);
  std::map<std::string, std::string> states;
  for (const HashLine& line : readHashes(dir / "plain.txt")) states[line.frame] = line.state;
  ASSERT_EQ(states.size(), 180U);
  const std::vector<HashLine> shown = readHashes(dir / "edited.txt");
  // 0.5 s, 0.5 s at 0.3, 1 s, 1 s at 3, two pauses and a card of 0.5 s each
  EXPECT_EQ(shown.size(), 30U + 100U + 60U + 20U + 90U);
  int before = 0;
  for (const HashLine& line : shown) {
    EXPECT_EQ(line.state, states.at(line.frame)) << line.frame;
    EXPECT_GE(std::stoi(line.frame), before);
    before = std::stoi(line.frame);
  }
}

TEST(Timeline, GivesTheSameBytesForAnyNumberOfWorkers) {
  const TempDir dir;
  const std::string scene = dir.write("scene.toml", std::string(kWorld) + kTimeline).string();
  const auto bytes = [&](const std::string& jobs) {
    const std::string out = (dir / "x.mp4").string();
    EXPECT_EQ(
        offstage({"render", scene, "-o", out, "--jobs", jobs, "--hash", (dir / "h.txt").string()}).status, 0);
    return readFile(out) + readFile(dir / "h.txt");
  };
  const std::string one = bytes("0");
  EXPECT_EQ(one, bytes("1"));
  EXPECT_EQ(one, bytes("3"));
}

TEST(Timeline, AStillIsTheVideosFrameAndFromCutsInVideoTime) {
  const TempDir dir;
  const std::string scene = dir.write("scene.toml", std::string(kWorld) + kTimeline).string();
  std::filesystem::create_directory(dir / "f");
  ASSERT_EQ(offstage({"render", scene, "-o", (dir / "f/%03d.png").string()}).status, 0);
  for (const int frame : {6, 45, 70, 100, 140, 160, 220, 299}) {
    const std::string at = std::to_string((frame + 0.1) / 60.0);
    ASSERT_EQ(offstage({"still", scene, "--at", at, "-o", (dir / "still.png").string()}).status, 0);
    const std::string name = std::to_string(1000 + frame).substr(1) + ".png";
    const ProcessResult diff = offstage({"diff", (dir / "f" / name).string(), (dir / "still.png").string()});
    EXPECT_EQ(diff.status, 0) << frame << diff.out;
  }
  std::filesystem::create_directory(dir / "g");
  ASSERT_EQ(
      offstage({"render", scene, "-o", (dir / "g/%03d.png").string(), "--from", "1.5", "--to", "1.7"}).status,
      0);
  EXPECT_EQ(dir.names("g").size(), 12U);
  EXPECT_EQ(readFile(dir / "g/000.png"), readFile(dir / "f/090.png"));
  EXPECT_EQ(readFile(dir / "g/011.png"), readFile(dir / "f/101.png"));
  const ProcessResult late = offstage({"render", scene, "-o", (dir / "x.mp4").string(), "--from", "5.5"});
  EXPECT_EQ(late.status, 2);
  const ProcessResult later = offstage({"still", scene, "--at", "5.5", "-o", (dir / "x.png").string()});
  EXPECT_EQ(later.status, 2);
  EXPECT_THAT(later.err, HasSubstr("--at 5.5 does not lie within the video's 0 … 5 s"));
}

TEST(Timeline, TextsComeAndGoByTheVideosTimeWhileThePictureStands) {
  const TempDir dir;
  const std::string scene =
      dir.write("scene.toml", std::string(kWorld) +
                                  "[[pause]]\nat = 0\nfor = 1\n[[text]]\ntext = \"t = {t:.1f}\"\n"
                                  "place = \"center\"\nsize = 20\nfrom = 0.2\nto = 0.4\n")
          .string();
  std::filesystem::create_directory(dir / "f");
  ASSERT_EQ(offstage({"render", scene, "-o", (dir / "f/%02d.png").string(), "--to", "0.5"}).status, 0);
  const std::string without = readFile(dir / "f/11.png");
  const std::string with = readFile(dir / "f/12.png");
  EXPECT_NE(without, with);
  EXPECT_EQ(readFile(dir / "f/23.png"), with);
  EXPECT_EQ(readFile(dir / "f/24.png"), without);
}

TEST(Timeline, ADimmingPauseLightsABodyWithWhatIsPaintedOverIt) {
  const TempDir dir;
  const std::string marks = "[[mark]]\nshape = \"dot\"\nsize = 8\ncolor = \"#ff0000\"\n";
  const std::string pause = "[[pause]]\nat = 0\nfor = 1\nhighlight = [\"ball\"]\nstyle = \"dim\"\n";
  const std::string scene = dir.write("scene.toml", kWorld + marks + pause).string();
  ASSERT_EQ(offstage({"still", scene, "--at", "0.5", "-o", (dir / "x.png").string()}).status, 0);
  const Image image = loadImage(dir / "x.png");
  const auto red = [&image](std::size_t x, std::size_t y) {
    const std::uint8_t* texel = &image.rgba[4 * (y * 160 + x)];
    EXPECT_EQ(int{texel[1]}, 0);
    EXPECT_EQ(int{texel[2]}, 0);
    return int{texel[0]};
  };
  EXPECT_EQ(red(40, 15), 255) << "the mark of the body that is pointed at";
  EXPECT_NEAR(red(120, 40), 255 * 0.45, 1.0) << "the mark of another";
}

TEST(Timeline, ATitleCardHidesTheScene) {
  const TempDir dir;
  const auto card = [&](const std::string& color) {
    std::string text = kWorld;
    text.replace(text.find("radius = 8"), 10, "radius = 8\nfill = \"" + color + "\"");
    const std::string scene =
        dir.write("scene.toml", text + "[[section]]\ntitle = \"A\"\nstart = 0\ncard = 1\n").string();
    const std::string out = (dir / "card.png").string();
    EXPECT_EQ(offstage({"still", scene, "--at", "0.5", "-o", out}).status, 0);
    return readFile(out);
  };
  EXPECT_EQ(card("red"), card("blue"));
}

TEST(Camera, StaysHomeUntilItsFirstMoveAndArrivesWhereItGoes) {
  CameraMove move;
  move.at = 1.0;
  move.length = 2.0;
  move.center.point = Vec2(40, 30);
  move.zoom = 2.0;
  move.easing = Easing::Linear;
  const Camera camera({move}, Vec2(160, 120));
  const Viewport home = Viewport::fitted(160, 120, 400, 240);
  const auto nowhere = [](std::uint32_t) { return Vec2(0, 0); };
  const Viewport before = camera.at(0.99, home, nowhere);
  EXPECT_EQ(before.scale, home.scale);
  EXPECT_EQ(before.offset, home.offset);
  const Viewport after = camera.at(3.0, home, nowhere);
  EXPECT_EQ(after.scale, 2.0 * home.scale);
  const Vec2 middle = home.offset + Vec2(80, 60) * home.scale;
  EXPECT_EQ(Vec2(Vec2(40, 30) * after.scale + after.offset), middle);
  EXPECT_EQ(after.clip, home.clip);
  const Viewport half = camera.at(2.0, home, nowhere);
  EXPECT_DOUBLE_EQ(half.scale, home.scale / 0.75); // what is seen is 3/4 as wide
  EXPECT_NEAR((Vec2(60, 45) * half.scale + half.offset - middle).norm(), 0.0, 1e-9);
}

TEST(Camera, FollowsABodyAndGoesOnFromWhereItIs) {
  CameraMove follow;
  follow.length = 0.0;
  follow.center.body = 3;
  CameraMove away;
  away.at = 1.0;
  away.length = 1.0;
  away.center.point = Vec2(0, 0);
  const Camera camera({follow, away}, Vec2(100, 100));
  const Viewport home = Viewport::scaled(100, 100, 1.0);
  const auto body = [](std::uint32_t id) { return Vec2(id * 10.0, 20.0); };
  EXPECT_EQ(camera.followed(), std::vector<std::uint32_t>{3});
  EXPECT_EQ(Vec2(camera.at(0.5, home, body).offset), Vec2(20, 30));
  EXPECT_EQ(Vec2(camera.at(1.5, home, body).offset), Vec2(35, 40)); // smooth: half the way at half the time
  EXPECT_EQ(Vec2(camera.at(2.5, home, body).offset), Vec2(50, 50));
}

TEST(Camera, EasingsRunFrom0To1) {
  for (const Easing easing : {Easing::Linear, Easing::In, Easing::Out, Easing::Smooth}) {
    EXPECT_EQ(eased(easing, 0.0), 0.0);
    EXPECT_EQ(eased(easing, 1.0), 1.0);
    for (int i = 0; i < 10; ++i) EXPECT_LT(eased(easing, 0.1 * i), eased(easing, 0.1 * (i + 1))) << i;
  }
  EXPECT_EQ(eased(Easing::In, 0.5), 0.25);
  EXPECT_EQ(eased(Easing::Out, 0.5), 0.75);
  EXPECT_EQ(eased(Easing::Smooth, 0.5), 0.5);
}

} // namespace
} // namespace offstage::test
