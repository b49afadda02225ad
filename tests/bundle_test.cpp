#include "render/job/bundle_page.h"
#include "render/output/staged_folder.h"
#include "tests/support/bundle_scene.h"
#include "tests/support/process.h"
#include "tests/support/running.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"
#include "tests/support/track_decode.h"

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(StagedFolder, TakesThePlaceOnlyOfWhatItMade) {
  const TempDir dir;
  const auto make = [&](const std::string& name, const std::string& text) {
    StagedFolder folder(dir / name);
    writeFile(folder.temporary() / "a.txt", text);
    folder.commit();
  };
  make("new", "1");
  EXPECT_THAT(dir.names("new"), ElementsAre(".offstage", "a.txt"));
  make("new", "2");
  EXPECT_EQ(readFile(dir / "new/a.txt"), "2");
  std::filesystem::create_directory(dir / "empty");
  make("empty", "1");

  writeFile(dir / "new/a.txt", "mine");
  EXPECT_THAT(errorOf([&] { make("new", "3"); }), HasSubstr("2: '"));
  EXPECT_EQ(readFile(dir / "new/a.txt"), "mine");
  writeFile(dir / "empty/notes.txt", "mine");
  EXPECT_THAT(errorOf([&] { make("empty", "3"); }), HasSubstr("have come or changed since offstage made it"));
  dir.write("file", "x");
  EXPECT_THAT(errorOf([&] { make("file", "3"); }), HasSubstr("is there and is no folder"));
  std::filesystem::create_directory(dir / "other");
  dir.write("other/x", "x");
  EXPECT_THAT(errorOf([&] { make("other", "3"); }), HasSubstr("is a folder that offstage has not made"));
  std::filesystem::create_directory_symlink(dir / "other", dir / "link");
  EXPECT_THAT(errorOf([&] { make("link", "3"); }), HasSubstr("is there and is no folder"));
  EXPECT_THAT(dir.names(), ElementsAre("empty", "file", "link", "new", "other")); // nothing temporary is left
}

TEST(StagedFolder, LeavesNothingWhenItIsGivenUp) {
  const TempDir dir;
  {
    const StagedFolder folder(dir / "x");
    writeFile(folder.temporary() / "a", "a");
  }
  EXPECT_THAT(dir.names(), ElementsAre());
}

TEST(BundlePage, EscapesEveryText) {
  BundleContents contents;
  contents.title = "a \"b\" <i>&";
  contents.mp4 = "50% ä.mp4";
  contents.files = {"50% ä.mp4"};
  contents.captions = {{0, 1500000000, "</script><b>\n\"x\""}};
  const std::string page = bundlePage(contents);
  EXPECT_THAT(page, HasSubstr("<title>a &quot;b&quot; &lt;i&gt;&amp;</title>"));
  EXPECT_THAT(page, HasSubstr("<source src=\"50%25%20%C3%A4.mp4\""));
  EXPECT_THAT(page, HasSubstr("\"captions\":[[0.000,1.500,\"\\u003c/script>\\u003cb>\\u000a\\\"x\\\"\"]]"));
  EXPECT_THAT(page, Not(HasSubstr("{{")));
}

TEST(Bundle, HoldsEverythingThatALecturesPageNeeds) {
  const TempDir dir;
  const std::string scene = dir.write("lecture.toml", kBundleScene).string();
  const std::string out = (dir / "out").string();
  const ProcessResult result = offstage({"bundle", scene, "-o", out, "--progress", "none"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(dir.names("out"),
              ElementsAre(".offstage", "index.html", "lecture.chapters.vtt", "lecture.csv", "lecture.gif",
                          "lecture.jpg", "lecture.mp4", "lecture.vtt", "lecture.webm"));
  EXPECT_THAT(dir.names(), ElementsAre("lecture.toml", "out"));
  EXPECT_THAT(readFile(dir / "out/lecture.vtt"),
              HasSubstr("00:00:00.000 --> 00:00:00.800\nfalls &amp; falls\n"));
  EXPECT_THAT(readFile(dir / "out/lecture.chapters.vtt"),
              HasSubstr("00:00:01.000 --> 00:00:02.000\n&lt;/script&gt;\n"));
  EXPECT_THAT(readFile(dir / "out/lecture.csv"),
              HasSubstr("frame,id,time,x,y,vx,vy,radius,group\n0,0,0,64,20,"));
  for (const char* video : {"out/lecture.mp4", "out/lecture.webm"}) {
    const DecodedTracks tracks = decodeTracks(dir / video);
    EXPECT_EQ(tracks.chapters.size(), 2U) << video;
    EXPECT_EQ(tracks.captions.size(), 2U) << video;
    EXPECT_FALSE(tracks.soundCodec.empty()) << video;
  }
  EXPECT_EQ(readFile(dir / "out/lecture.jpg").substr(0, 3), "\xff\xd8\xff");

  // Again: the same bytes take the place of the old ones; a file of somebody else's is never lost.
  const std::string before = readFile(dir / "out/lecture.mp4");
  EXPECT_EQ(offstage({"bundle", scene, "-o", out, "--progress", "none"}).status, 0);
  EXPECT_EQ(readFile(dir / "out/lecture.mp4"), before);
  writeFile(dir / "out/notes.txt", "mine");
  const ProcessResult refused = offstage({"bundle", scene, "-o", out, "--progress", "none"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("holds files that have come or changed since offstage made it"));
  EXPECT_EQ(readFile(dir / "out/notes.txt"), "mine");
  EXPECT_EQ(readFile(dir / "out/lecture.mp4"), before);
}

TEST(Bundle, OfATransparentSceneIsRefusedForWhatItIs) {
  const TempDir dir;
  const std::string scene =
      dir.write("s.toml", "duration = 0.1\n[frame]\nbackground = \"transparent\"\n").string();
  const ProcessResult result = offstage({"bundle", scene, "-o", dir / "out"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("s.toml: a bundle's videos have no transparency"));
  EXPECT_THAT(dir.names(), ElementsAre("s.toml"));
}

TEST(Bundle, AnInterruptedOneLeavesNothingAndPromisesNothing) {
  const TempDir dir;
  const std::string scene = dir.write("lecture.toml", kBundleScene).string();
  Running run({program(), "bundle", scene, "-o", (dir / "out").string(), "--jobs", "1", "--scale", "8"});
  const std::filesystem::path parts =
      dir / ("." + ("out." + std::to_string(run.id())) + ".partial/lecture.mp4.parts");
  ASSERT_TRUE(run.waitUntil([&] { return std::filesystem::exists(parts / "000000.chunk"); }));
  run.signal(SIGINT);
  EXPECT_EQ(run.finish(), 130);
  EXPECT_THAT(run.errors(), HasSubstr("interrupted"));
  EXPECT_THAT(run.errors(), Not(HasSubstr("kept")));
  EXPECT_THAT(dir.names(), ElementsAre("lecture.toml"));
}

TEST(Poster, IsDrawnAtItsMomentInItsResolution) {
  const TempDir dir;
  const std::string scene = dir.write("scene.toml", kBundleScene).string();
  const std::string poster = (dir / "p.png").string();
  ASSERT_EQ(offstage({"render", scene, "--poster", poster, "--scale", "4"}).status, 0);
  ASSERT_EQ(offstage({"still", scene, "--at", "0.5", "--scale", "4", "-o", (dir / "s.png").string()}).status,
            0);
  EXPECT_EQ(readFile(poster), readFile(dir / "s.png"));
  // pHYs: 288 to the inch are 11339 to the metre, both ways, unit 1.
  EXPECT_THAT(readFile(poster), HasSubstr(std::string("pHYs\0\0\x2c\x4b\0\0\x2c\x4b\1", 13)));
  EXPECT_EQ(offstage({"render", scene, "--poster", (dir / "p.bmp").string()}).status, 2);
  EXPECT_EQ(offstage({"render", scene, "--poster", (dir / "none/p.png").string()}).status, 2);
  ASSERT_EQ(offstage({"render", scene, "--poster", (dir / "p.jpg").string(), "-o", (dir / "x.mp4").string()})
                .status,
            0);
  EXPECT_EQ(readFile(dir / "p.jpg").substr(0, 3), "\xff\xd8\xff");
  EXPECT_TRUE(std::filesystem::exists(dir / "x.mp4"));
}

TEST(Poster, ShowsTheMiddleOfWhatIsRenderedOrWhatTheSceneSays) {
  const TempDir dir;
  const std::string world = "duration = 4\n[frame]\nsize = [64, 48]\n[[body]]\ncenter = [8, 24]\nradius = 6\n"
                            "velocity = [12, 0]\n[world]\ngravity = [0, 0]\n";
  const std::string scene = dir.write("scene.toml", world).string();
  const std::string named = dir.write("named.toml", world + "[poster]\nat = 3\n").string();
  const std::string out = (dir / "p.png").string();
  const auto posterIs = [&](const std::string& file, const std::vector<std::string>& options,
                            const std::string& at, const std::string& told) {
    std::vector<std::string> command{"render", file, "--poster", out};
    command.insert(command.end(), options.begin(), options.end());
    const ProcessResult result = offstage(command);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, told);
    EXPECT_EQ(offstage({"still", scene, "--at", at, "-o", (dir / "s.png").string()}).status, 0);
    EXPECT_EQ(readFile(out), readFile(dir / "s.png")) << at;
  };
  posterIs(scene, {}, "2", "");
  posterIs(scene, {"--to", "1"}, "0.5", "");
  posterIs(scene, {"--from", "3"}, "3.5", "");
  posterIs(scene, {"--from", "1", "--to", "2", "-o", (dir / "x.mp4").string()}, "1.5", "");
  posterIs(scene, {"--duration", "1"}, "0.5", "");
  posterIs(named, {}, "3", "");
  posterIs(named, {"--from", "2"}, "3", "");
  posterIs(named, {"--to", "1"}, "3",
           "offstage: the poster shows 3 s, as [poster] says, which is not within the rendered 0 … 1 s\n");
  posterIs(named, {"--duration", "1"}, "0.5",
           "offstage: the video ends at 1 s, before the 3 s of [poster]: the poster shows 0.5 s\n");
  EXPECT_EQ(offstage({"render", named, "--poster", out, "--to", "9"}).status, 2);

  ASSERT_EQ(offstage({"bundle", scene, "-o", (dir / "b").string(), "--to", "1"}).status, 0);
  ASSERT_EQ(offstage({"render", scene, "--poster", (dir / "s.jpg").string(), "--to", "1"}).status, 0);
  EXPECT_EQ(readFile(dir / "b/scene.jpg"), readFile(dir / "s.jpg"));
}

/// A program's posters are those of the scene that shows the same: in the middle of the video, in any size.
TEST(Poster, OfAProgramIsThatOfItsScene) {
  const TempDir dir;
  const std::string program = OFFSTAGE_BINARY_DIR "/programs/exercise1_bounce";
  const auto made = [&](std::vector<std::string> command, const std::string& name) {
    command.insert(command.end(), {"--poster", (dir / name).string(), "--scale", "1.5"});
    const ProcessResult result = runProcess(command);
    EXPECT_EQ(result.status, 0) << result.err;
    return readFile(dir / name);
  };
  const std::vector<std::string> render{offstage::test::program(), "render", scene("exercise1_bounce")};
  EXPECT_EQ(made({program}, "program.png"), made(render, "scene.png"));
  EXPECT_EQ(made({program}, "program.jpg"), made(render, "scene.jpg"));
  EXPECT_THAT(dir.names(), ElementsAre("program.jpg", "program.png", "scene.jpg", "scene.png")); // no video

  EXPECT_THAT(made({program, "--duration", "0.1", "-o", (dir / "x.mp4").string()}, "x.png"),
              Not(readFile(dir / "program.png"))); // the middle is another moment
  EXPECT_TRUE(std::filesystem::exists(dir / "x.mp4"));
  const ProcessResult refused = runProcess({program, "--poster", (dir / "p.bmp").string()});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("a poster ends in .png, .jpg or .jpeg"));
}

} // namespace
} // namespace offstage::test
