#include "tests/support/process.h"
#include "tests/support/running.h"
#include "tests/support/temp_dir.h"

#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kBall = "duration = 0.1\n[frame]\nsize = [64, 48]\n[[body]]\nshape = \"circle\"\n"
                              "center = [20, 20]\nradius = 9\nvelocity = [60, 0]\n";

/// Runs in the folder, so that names can be bare.
ProcessResult renderIn(const TempDir& dir, std::vector<std::string> arguments) {
  ProcessOptions options;
  options.directory = dir.path();
  arguments.insert(arguments.begin(), "render");
  return offstage(std::move(arguments), options);
}

bool isTemporary(const std::string& name) {
  return name.starts_with('.');
}

TEST(OutputPlaces, TwoNamesOfOneFileThatIsNotThereYetAreOnePlace) {
  const TempDir dir;
  dir.write("s.toml", kBall);
  dir.write("captions.toml", std::string(kBall) + "[[caption]]\nfrom = 0\nto = 0.1\ntext = \"a ball\"\n");
  const std::vector<std::vector<std::string>> cases{{"s.toml", "-o", "x.mp4", "--hash", "./x.mp4"},
                                                    {"s.toml", "-o", "x.mp4", "--hash", dir / "x.mp4"},
                                                    {"s.toml", "-o", "x%d.png", "--poster", "x5.png"},
                                                    {"s.toml", "-o", "x.mp4", "--hash", "x.mp4.parts"},
                                                    {"s.toml", "-o", "x.mp4", "--hash", "./x.mp4.parts/h"},
                                                    {"s.toml", "-o", "./p.png%d.png", "--hash", "p.png3.png"},
                                                    {"captions.toml", "-o", "r.mp4", "--hash", "r.vtt"}};
  for (const std::vector<std::string>& arguments : cases) {
    const ProcessResult result = renderIn(dir, arguments);
    EXPECT_EQ(result.status, 2) << arguments.back();
    EXPECT_THAT(result.err, HasSubstr("cannot both be")) << arguments.back();
    EXPECT_THAT(dir.names(), ElementsAre("captions.toml", "s.toml")) << arguments.back();
  }
  const ProcessResult apart =
      renderIn(dir, {"s.toml", "-o", "r.mp4", "--hash", "r.vtt", "--poster", "P.PNG"});
  EXPECT_EQ(apart.status, 0) << apart.err; // there are no captions
}

TEST(OutputPlaces, NoCommandReplacesWhatTheSceneIsMadeWith) {
  const TempDir dir;
  const std::string bodies = "shape,x,y,radius\ncircle,20,20,9\n";
  dir.write("bodies.csv", bodies);
  dir.write("s.toml", "duration = 0.1\n[frame]\nsize = [64, 48]\n[[bodies]]\ntable = \"bodies.csv\"\n");
  dir.write("recorded.csv", "20000000\n20000000\n");
  dir.write("r.toml", "[frame]\nsize = [64, 48]\n[clock]\nrecorded = \"recorded.csv\"\n");
  ASSERT_EQ(renderIn(dir, {"s.toml", "--poster", "ball.png"}).status, 0);
  dir.write("image.toml", std::string(kBall) + "fill = { image = \"ball.png\" }\n");
  dir.write("panels.toml", std::string(kBall) +
                               "[[panel]]\n[[panel.body]]\nshape = \"circle\"\ncenter = [9, 9]\nradius = "
                               "5\nfill = { image = \"ball.png\" }\n[[panel]]\n");
  std::filesystem::copy_file("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", dir / "font.ttf");
  dir.write("text.toml", std::string(kBall) + "[[text]]\ntext = \"a\"\nfont = \"font.ttf\"\nat = [9, 9]\n");
  ASSERT_EQ(offstage({"trace", dir / "image.toml", "-o", dir / "t.csv"}).status, 0);
  dir.write("replay.toml", "[frame]\nsize = [64, 48]\n[replay]\ntrace = \"t.csv\"\n");
  const std::vector<std::string> names = dir.names();
  std::vector<std::string> before;
  before.reserve(names.size());
  for (const std::string& name : names) before.push_back(readFile(dir / name));
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"trace", "s.toml", "-o", "./bodies.csv"},
                                             {"trace", "s.toml", "-o", "x.csv", "--events", "bodies.csv"},
                                             {"trace", "s.toml", "-o", "x.csv", "--events", "./x.csv"},
                                             {"trace", "r.toml", "-o", "recorded.csv"},
                                             {"still", "image.toml", "--at", "0", "-o", "ball.png"},
                                             {"still", "panels.toml", "--at", "0", "-o", "ball.png"},
                                             {"render", "text.toml", "--hash", "font.ttf"},
                                             {"render", "replay.toml", "--hash", "t.csv"}}) {
    ProcessOptions options;
    options.directory = dir.path();
    const ProcessResult result = offstage(arguments, options);
    EXPECT_EQ(result.status, 2) << arguments[1] << " " << arguments.back() << result.err;
    EXPECT_THAT(result.err, HasSubstr("cannot both be")) << arguments[1] << " " << arguments.back();
    EXPECT_EQ(dir.names(), names) << arguments[1];
    for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(readFile(dir / names[i]), before[i]) << names[i];
  }
}

TEST(OutputPlaces, ANameThatCannotBeIsToldWithItsReason) {
  const TempDir dir;
  dir.write("s.toml", kBall);
  std::filesystem::create_symlink("there", dir / "here");
  std::filesystem::create_symlink("here", dir / "there");
  const std::string longName(252, 'a');
  for (const auto& [out, reason] : {std::pair{longName + ".mp4", "the name is too long"},
                                    {longName + "%05d.png", "the name is too long"},
                                    {"here/x.mp4", "its symbolic links lead in a circle"}}) {
    const ProcessResult result = renderIn(dir, {"s.toml", "-o", out});
    EXPECT_EQ(result.status, 2) << out;
    EXPECT_THAT(result.err, HasSubstr(std::string("': ") + reason)) << out;
  }
}

TEST(OutputPlaces, WhatAVideoIsMadeFromIsNotReplacedByIt) {
  const TempDir dir;
  const std::string text = std::string(kBall) + "[clock]\nfps = 50\n";
  dir.write("s.toml", text);
  dir.write("a.dt", "20000000\n20000000\n");
  dir.write("told.toml", std::string(kBall) + "[narration]\nfile = \"told.mp4\"\n");
  ASSERT_EQ(renderIn(dir, {"s.toml", "-o", "told.mp4"}).status, 0);
  ASSERT_EQ(renderIn(dir, {"s.toml", "--poster", "ball.png"}).status, 0);
  dir.write("image.toml", std::string(kBall) + "fill = { image = \"ball.png\" }\n");
  const std::string told = readFile(dir / "told.mp4");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"s.toml", "--hash", "s.toml"},
                                             {"s.toml", "--dt", "a.dt", "-o", "b.mp4", "--hash", "./a.dt"},
                                             {"image.toml", "-o", "c.mp4", "--poster", "./ball.png"},
                                             {"told.toml", "-o", "told.mp4"}}) {
    const ProcessResult result = renderIn(dir, arguments);
    EXPECT_EQ(result.status, 2) << arguments.back() << result.err;
  }
  EXPECT_EQ(readFile(dir / "s.toml"), text);
  EXPECT_EQ(readFile(dir / "told.mp4"), told);
}

TEST(OutputPlaces, AMessageNamesBothThingsAndTheirPlace) {
  const TempDir dir;
  dir.write("s.toml", kBall);
  ASSERT_EQ(renderIn(dir, {"s.toml", "--poster", "ball.png"}).status, 0);
  dir.write("image.toml", std::string(kBall) + "fill = { image = \"ball.png\" }\n");
  EXPECT_EQ(renderIn(dir, {"image.toml", "--poster", "ball.png"}).err,
            "offstage: error: --poster and an image of the scene cannot both be 'ball.png'\n");
  EXPECT_EQ(renderIn(dir, {"s.toml", "-o", "x.mp4", "--hash", "x.mp4.parts"}).err,
            "offstage: error: --hash and the folder of the parts cannot both be 'x.mp4.parts'\n");
}

TEST(OutputPlaces, AStillsEndingMayBeUpperCase) {
  const TempDir dir;
  dir.write("s.toml", kBall);
  ProcessOptions options;
  options.directory = dir.path();
  const ProcessResult result = offstage({"still", "s.toml", "--at", "0", "-o", "x.PNG"}, options);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(dir / "x.PNG"));
}

TEST(OutputPlaces, WhatKilledRunsLeftOfABareNameIsRemoved) {
  const TempDir dir;
  dir.write("s.toml", kBall);
  for (const char* name : {"x.mp4", "x.raw", "h.txt", "p.png", "3.png"})
    dir.write("." + std::string(name) + ".4194305.partial", "cut off");
  dir.write(".other.mp4.4194305.partial", "another's");
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"s.toml", "-o", "x.mp4", "--hash", "h.txt", "--poster", "p.png"},
           {"s.toml", "-o", "x.raw"},
           {"s.toml", "-o", "%d.png"}})
    EXPECT_EQ(renderIn(dir, arguments).status, 0) << arguments.back();
  std::vector<std::string> left = dir.names();
  std::erase_if(left, [](const std::string& name) { return !isTemporary(name); });
  EXPECT_THAT(left, ElementsAre(".other.mp4.4194305.partial"));
}

TEST(OutputPlaces, ALogMayBeSpelledOtherwiseForTheNextSegment) {
  const TempDir dir;
  dir.write("s.toml", kBall);
  std::string log;
  for (int frame = 0; frame < 200; ++frame) log += "20000000\n";
  dir.write("a.dt", log);
  const ProcessResult first =
      renderIn(dir, {"s.toml", "--dt", "a.dt", "--duration", "4", "--segment", "1/2", "-o", "x.mp4"});
  const ProcessResult second =
      renderIn(dir, {"s.toml", "--dt", "./a.dt", "--duration", "4", "--segment", "2/2", "-o", "x.mp4"});
  EXPECT_EQ(first.status + second.status, 0) << first.err << second.err;
  EXPECT_THAT(second.err, Not(HasSubstr("starting over")));
  EXPECT_EQ(offstage({"join", dir / "s.toml", "-o", dir / "x.mp4"}).status, 0);
}

TEST(OutputPlaces, SegmentsOfAnotherDriverAreNotJoined) {
  const TempDir dir;
  dir.write("s.toml", kBall);
  const std::vector<std::string> arguments{"render", "s.toml", "--duration", "2",
                                           "-o",     "x.mp4",  "--segment",  "1/2"};
  ProcessOptions other;
  other.directory = dir.path();
  other.environment = {{"GALLIUM_DRIVER", "softpipe"}};
  EXPECT_EQ(offstage(arguments, other).status, 0);
  const ProcessResult joined = offstage({"join", dir / "s.toml", "-o", dir / "x.mp4"});
  EXPECT_EQ(joined.status, 2);
  EXPECT_THAT(joined.err, HasSubstr("which differs in the driver"));
}

TEST(OutputPlaces, WhatIsNoFileInTheWayIsAnErrorAndNoHang) {
  const TempDir dir;
  dir.write("s.toml", std::string(kBall) + "[[caption]]\nfrom = 0\nto = 0.1\ntext = \"a ball\"\n");
  ASSERT_EQ(mkfifo((dir / "g.vtt").c_str(), 0600), 0);
  std::filesystem::create_directory(dir / "e.vtt");
  std::filesystem::create_directory(dir / "m.mp4.parts");
  ASSERT_EQ(mkfifo((dir / "m.mp4.parts/manifest").c_str(), 0600), 0);
  for (const char* out : {"g.mp4", "e.mp4"}) {
    Running run({program(), "render", dir / "s.toml", "-o", dir / out});
    ASSERT_TRUE(run.wait(20000)) << out;
    EXPECT_EQ(run.finish(), 2) << out;
    EXPECT_THAT(run.errors(), HasSubstr("cannot write")) << out;
  }
  Running join({program(), "join", dir / "s.toml", "-o", dir / "m.mp4"});
  ASSERT_TRUE(join.wait(20000));
  EXPECT_EQ(join.finish(), 2);
}

TEST(OutputPlaces, APosterThatCannotBeIsRefusedBeforeTheVideoIsMade) {
  const TempDir dir;
  dir.write("s.toml", "duration = 0.1\n[frame]\nsize = [64, 48]\nbackground = \"transparent\"\n");
  const ProcessResult result = renderIn(dir, {"s.toml", "-o", "x.webm", "--poster", "p.jpg"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("a JPEG has no transparency"));
  EXPECT_THAT(dir.names(), ElementsAre("s.toml"));
}

TEST(OutputPlaces, ASignalLeavesNothingUnfinished) {
  struct Case {
    const char* out;
    int signal;
  };
  for (const Case& tested : {Case{"x.raw", SIGHUP}, Case{"x.raw", SIGTERM}, Case{"%d.png", SIGTERM},
                             Case{"%d.png", SIGHUP}, Case{"x.mkv", SIGHUP}}) {
    const TempDir dir;
    Running run({program(), "render", scene("exercise2_bounce"), "--size", "640x480", "--duration", "600",
                 "-o", dir / tested.out});
    const auto begun = [&] {
      const std::vector<std::string> names = dir.names();
      return std::ranges::any_of(names, isTemporary) ||
             std::ranges::any_of(names, [](const std::string& name) { return name.ends_with(".parts"); });
    };
    ASSERT_TRUE(run.waitUntil(begun)) << tested.out;
    run.wait(300);
    run.signal(tested.signal);
    EXPECT_EQ(run.finish(), 128 + tested.signal) << tested.out;
    const std::vector<std::string> names = dir.names();
    EXPECT_EQ(std::ranges::count_if(names, isTemporary), 0) << tested.out << ": " << names.front();
  }
}

TEST(OutputPlaces, AReaderThatStandsStillDoesNotKeepARenderAlive) {
  const TempDir dir;
  ASSERT_EQ(mkfifo((dir / "pipe").c_str(), 0600), 0);
  const int reader = open((dir / "pipe").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC); // and reads nothing
  ASSERT_GE(reader, 0);
  Running run({"/bin/sh", "-c", "exec \"$@\" >\"$0\"", dir / "pipe", program(), "render",
               scene("exercise2_bounce"), "--size", "640x480", "-o", "-"});
  run.wait(1500); // the pipe is full by then
  run.signal(SIGTERM);
  EXPECT_TRUE(run.wait(10000)) << "it waits on";
  run.signal(SIGKILL);
  EXPECT_EQ(run.finish(), 128 + SIGTERM);
  close(reader);
}

/// 47 frames: the last rests on a frame that the check leaves out, which libav would complain of.
TEST(OutputPlaces, AGoodVideoIsMadeWithoutAWord) {
  const TempDir dir;
  dir.write("s.toml", kBall);
  for (const char* seconds : {"0.7834", "1.55", "1.6"}) {
    for (const char* quality : {"draft", "good", "high"}) {
      const ProcessResult result = renderIn(
          dir, {"s.toml", "--duration", seconds, "-o", "x.mp4", "--quality", quality, "--progress", "none"});
      EXPECT_EQ(result.status, 0) << result.err;
      EXPECT_EQ(result.err, "") << seconds << " s, " << quality;
    }
  }
}

TEST(OutputPlaces, ALongTitleDoesNotHideAnAnimation) {
  const TempDir dir;
  dir.write("s.toml", "title = \"" + std::string(20000, 'x') + "\"\n" + kBall);
  const ProcessResult result = renderIn(dir, {"s.toml", "-o", "x.apng"});
  EXPECT_EQ(result.status, 0) << result.err;
}

} // namespace
} // namespace offstage::test
