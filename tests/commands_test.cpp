#include "render/draw/image.h"
#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

TEST(Commands, HelpOfEveryVerbGoesToStdoutWithStatus0) {
  for (const std::vector<std::string>& verb : std::vector<std::vector<std::string>>{
           {}, {"render"}, {"still"}, {"trace"}, {"join"}, {"diff"}, {"golden"}, {"check"}, {"doctor"}}) {
    std::vector<std::string> arguments = verb;
    arguments.emplace_back("--help");
    const ProcessResult result = offstage(arguments);
    EXPECT_EQ(result.status, 0);
    EXPECT_THAT(result.out, HasSubstr("Usage:"));
    EXPECT_EQ(result.err, "");
  }
}

TEST(Commands, BadUsageIsStatus2WithAMessageAndNoOutput) {
  const TempDir dir;
  const std::string out = (dir / "x.mp4").string();
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{}, "subcommand"},
      {{"rendr"}, "rendr"},
      {{"render"}, "SCENE"},
      {{"render", scene("fall")}, "-o OUT"},
      {{"render", scene("fall"), "-o", out, "--frobnicate"}, "--frobnicate"},
      {{"render", scene("fall"), "-o", out, "--size", "640"}, "--size '640'"},
      {{"render", scene("fall"), "-o", out, "--size", "0x480"}, "--size '0x480'"},
      {{"render", scene("fall"), "-o", out, "--size", "100000x100000"}, "100000"},
      {{"render", scene("fall"), "-o", out, "--fps", "nan"}, "--fps"},
      {{"render", scene("fall"), "-o", out, "--fps", "60x"}, "'60x'"},
      {{"render", scene("fall"), "-o", out, "--fps", "0"}, "fps"},
      {{"render", scene("fall"), "-o", out, "--duration", "-1"}, "duration"},
      {{"render", scene("fall"), "-o", out, "--seed", "1.5"}, "--seed"},
      {{"render", scene("fall"), "-o", out, "--scale", "0"}, "scale"},
      {{"render", scene("fall"), "-o", out, "--from", "5", "--to", "4"}, "5"},
      {{"render", scene("fall"), "-o", out, "--to", "99"}, "--to 99"},
      {{"render", scene("fall"), "-o", out, "--progress", "loud"}, "--progress"},
      {{"render", scene("fall"), "-o", out, "--dt", (dir / "none.dt").string()}, "none.dt"},
      {{"render", (dir / "none.toml").string(), "-o", out}, "none.toml"},
      {{"render", scene("fall"), "-o", (dir / "x.txt").string()}, ".txt"},
      {{"render", scene("fall"), "-o", (dir / "x.png").string()}, ".png"},
      {{"render", scene("fall"), "-o", (dir / "missing" / "x.mp4").string()}, "missing"},
      {{"render", scene("fall"), "-o", dir.path().string()}, dir.path().string()},
      {{"render", scene("fall"), "-o", out, "--quality", "best"}, "--quality 'best'"},
      {{"render", scene("fall"), "-o", out, "--quality", "lossless"}, "use .mkv"},
      {{"render", scene("fall"), "-o", out, "--jobs", "-1"}, "--jobs '-1'"},
      {{"render", scene("fall"), "-o", out, "--jobs", "two"}, "--jobs 'two'"},
      {{"render", scene("fall"), "-o", out, "--segment", "2/1"}, "--segment '2/1'"},
      {{"join", scene("fall")}, "-o OUT"},
      {{"join", scene("fall"), "-o", out}, "render the segments first"},
      {{"still", scene("fall"), "-o", out, "--at", "1"}, ".png"},
      {{"still", scene("fall"), "-o", (dir / "x.png").string(), "--at", "11"}, "--at 11"},
      {{"still", scene("fall"), "-o", (dir / "x.png").string(), "--at", "-1"}, "--at"},
      {{"still", scene("fall"), "-o", (dir / "x.png").string(), "--at", "1", "--strobe", "0"}, "--strobe"},
      {{"trace", scene("fall"), "-o", (dir / "x.txt").string()}, ".csv"},
      {{"trace", scene("fall"), "-o", "-", "--events", "-"}, "same place"},
      {{"check"}, "SCENE"},
  };
  for (const auto& [arguments, text] : cases) {
    const ProcessResult result = offstage(arguments);
    const std::string shown = ::testing::PrintToString(arguments) + "\n" + result.err;
    EXPECT_EQ(result.status, 2) << shown;
    EXPECT_THAT(result.err, HasSubstr(text)) << shown;
    EXPECT_EQ(result.out, "") << shown;
    EXPECT_THAT(dir.names(), IsEmpty()) << shown;
  }
}

TEST(Commands, RenderSaysWhatItMadeAndNothingElseWhenPiped) {
  const TempDir dir;
  const std::string out = (dir / "fall.mp4").string();
  const ProcessResult result = offstage({"render", scene("fall"), "-o", out, "--duration", "0.5"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith(out + ": 30 frames, 0.500 s, in "));
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(dir.names(), ElementsAre("fall.mp4"));
}

TEST(Commands, OddSizesArePaddedAndItSaysSoOnce) {
  const TempDir dir;
  const ProcessResult result =
      offstage({"render", scene("fall"), "-o", dir / "odd.mp4", "--duration", "0.1", "--size", "641x480"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "offstage: width 641 is odd: padded to 642 by repeating the last column\n");
}

TEST(Commands, TransparencyIsRefusedWhereTheFormatHasNoneAndKeptWhereItHas) {
  const TempDir dir;
  const std::string file = dir.write("t.toml", "[frame]\nbackground = \"transparent\"\n");
  const ProcessResult refused = offstage({"render", file, "-o", dir / "t.mp4"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("transparency"));
  const ProcessResult raw = offstage({"render", file, "-o", "-", "--duration", "0.01"});
  EXPECT_EQ(raw.status, 0) << raw.err;
  EXPECT_EQ(raw.out, std::string(640U * 480U * 4U, '\0'));
}

TEST(Commands, RenderTellsProgressAsJsonLines) {
  const TempDir dir;
  const ProcessResult result = offstage(
      {"render", scene("fall"), "-o", (dir / "f.mp4").string(), "--duration", "0.2", "--progress", "json"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("\"event\":\"done\",\"frame\":12,\"frames\":12,"));
}

TEST(Commands, RawPipeHoldsEveryPixelOfEveryFrameAndTheSummaryGoesToStderr) {
  const ProcessResult result =
      offstage({"render", scene("shapes"), "-o", "-", "--duration", "0.05", "--size", "64x48"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out.size(), 3U * 64U * 48U * 4U);
  EXPECT_THAT(result.err, HasSubstr("3 frames"));
}

TEST(Commands, AClosedPipeIsAnErrorNotASilentDeath) {
  ProcessOptions options;
  options.closedOutput = true;
  const ProcessResult result = offstage({"render", scene("fall"), "-o", "-"}, options);
  EXPECT_NE(result.status, 0);
  EXPECT_LT(result.status, 128) << "killed by a signal";
  EXPECT_THAT(result.err, HasSubstr("error"));
}

TEST(Commands, ARenderOutlivesWhoeverReadsItsMessages) {
  const TempDir dir;
  const std::vector<std::string> render{"render", scene("fall"), "-o", dir / "x.gif", "--progress", "json"};
  ProcessOptions nobodyReads;
  nobodyReads.closedOutput = true;
  nobodyReads.closedErrors = true;
  EXPECT_EQ(offstage(render, nobodyReads).status, 0);
  EXPECT_THAT(dir.names(), ElementsAre("x.gif"));
  const std::string expected = readFile(dir / "x.gif");

  // With nothing behind the numbers 0 to 2 the first files opened would take them, and get the messages.
  for (const std::string closed : {"<&- >&- 2>&-", "2>&-", ">&-", ">/dev/full 2>/dev/full"}) {
    for (const std::string jobs : {"0", "2"}) {
      std::filesystem::remove(dir / "x.gif");
      std::vector<std::string> command{"/bin/sh", "-c", "exec \"$@\" " + closed, "sh", program()};
      command.insert(command.end(), render.begin(), render.end());
      command.insert(command.end(), {"--jobs", jobs});
      EXPECT_EQ(runProcess(command).status, 0) << closed;
      EXPECT_TRUE(readFile(dir / "x.gif") == expected) << closed << " with " << jobs << " jobs";
    }
  }
}

TEST(Commands, ResultsThatDoNotArriveAreAnErrorNotASuccess) {
  const TempDir dir;
  for (const std::string verb : {"check", "trace"}) {
    const ProcessResult full =
        runProcess({"/bin/sh", "-c", "exec \"$@\" >/dev/full", "sh", program(), verb, scene("fall")});
    EXPECT_EQ(full.status, 75) << verb;
    EXPECT_EQ(full.err, "offstage: error: cannot write to standard output: no space left on its disk\n")
        << verb;
  }
}

TEST(Commands, ADifferenceThatDoesNotArriveIsAnErrorToo) {
  const TempDir dir;
  for (const char* at : {"0", "1"})
    ASSERT_EQ(offstage({"still", scene("fall"), "--at", at, "-o", dir / (std::string(at) + ".png")}).status,
              0);
  const ProcessResult full = runProcess(
      {"/bin/sh", "-c", "exec \"$@\" >/dev/full", "sh", program(), "diff", dir / "0.png", dir / "1.png"});
  EXPECT_EQ(full.status, 75) << full.err;
}

TEST(Commands, ARateIsRefusedWhereItWouldChangeNothing) {
  const TempDir dir;
  dir.write("r.dt", "16666667\n16666667\n16666666\n100000000\n33333333\n16666667\n");
  dir.write("r.toml",
            "[clock]\nrecorded = \"r.dt\"\n[[body]]\ncenter = [50, 30]\nradius = 10\nvelocity = [30, 0]\n");
  const ProcessResult trace = offstage({"trace", dir / "r.toml", "--fps", "30"});
  EXPECT_EQ(trace.status, 2);
  EXPECT_THAT(trace.err, HasSubstr("--fps: a trace has a row for every step"));
  EXPECT_EQ(trace.out, "");
  // The second frame of 30 a second, from 0.033 s on, shows what the recording showed then.
  EXPECT_THAT(offstage({"still", dir / "r.toml", "--at", "0.06", "--fps", "30", "-o", dir / "x.png"}).out,
              HasSubstr("frame 2 at 0.033"));
  EXPECT_THAT(offstage({"still", dir / "r.toml", "--at", "0.06", "-o", dir / "x.png"}).out,
              HasSubstr("frame 3 at 0.05 s"));
}

TEST(Commands, TwoOutputsInOnePlaceAreRefused) {
  const TempDir dir;
  const std::vector<std::vector<std::string>> cases{{"-o", dir / "x.mp4", "--hash", dir / "x.mp4"},
                                                    {"-o", dir / "x.raw", "--hash", dir / "./x.raw"},
                                                    {"-o", dir / "p%03d.png", "--poster", dir / "p004.png"},
                                                    {"--hash", dir / "h.png", "--poster", dir / "h.png"},
                                                    {"-o", dir / "x.mp4", "--hash", "-"}};
  for (const std::vector<std::string>& options : cases) {
    std::vector<std::string> arguments{"render", scene("fall"), "--duration", "0.1"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProcessResult result = offstage(arguments);
    EXPECT_EQ(result.status, 2) << options.back();
    EXPECT_THAT(result.err, AnyOf(HasSubstr("cannot both be"), HasSubstr("--hash writes to a file")));
    EXPECT_THAT(dir.names(), IsEmpty()) << options.back();
  }
  const ProcessResult apart = offstage(
      {"render", scene("fall"), "--duration", "0.1", "-o", dir / "p%03d.png", "--poster", dir / "p4.png"});
  EXPECT_EQ(apart.status, 0) << apart.err;
}

TEST(Commands, CtrlCBeforeTheFirstChunkEndsWith130AndLeavesNothing) {
  const TempDir dir;
  ProcessOptions options;
  options.interruptAfterMs = 700;
  const ProcessResult result = offstage({"render", scene("exercise2_bounce"), "-o", (dir / "x.mp4").string(),
                                         "--duration", "3000", "--size", "1280x960"},
                                        options);
  EXPECT_EQ(result.status, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("interrupted"));
  EXPECT_THAT(dir.names(), IsEmpty());
}

TEST(Commands, RecordedFramesThatAreTooShortForAFileAreTold) {
  const TempDir dir;
  dir.write("r.dt", "400000\n400000\n400000\n400000\n400000\n100000000\n");
  dir.write("s.toml", "[frame]\nsize = [64, 48]\n[clock]\nrecorded = \"r.dt\"\n"
                      "[[body]]\ncenter = [20, 20]\nradius = 9\nvelocity = [30, 0]\n");
  const auto told = [&](const std::string& out) {
    const ProcessResult result = offstage({"render", dir / "s.toml", "-o", dir / out});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.err;
  };
  // From 0, 0.4, 0.8, 1.2, 1.6, 2 to 102 ms: in whole ones 0, 0, 1, 1, 2, 2.
  const std::string three = "offstage: 3 of 6 frames are shorter than the unit of time of ";
  EXPECT_EQ(told("x.mkv"), three + "'x.mkv', and left out\n");
  EXPECT_EQ(told("x.apng"), three + "'x.apng', and left out\n");
  EXPECT_EQ(told("x.gif"),
            "offstage: 5 of 6 frames are shorter than the unit of time of 'x.gif', and left out\n");
  EXPECT_EQ(told("x.mp4"), "");
  EXPECT_EQ(told("%d.png"), "");
}

TEST(Commands, AFailedRenderKeepsTheFileThatWasThere) {
  const TempDir dir;
  const std::filesystem::path out = dir / "x.mp4";
  writeFile(out, "precious");
  writeFile(dir / "bad.toml", "[[body]]\nshape = \"circle\"\ncenter = [1, 2]\nradius = -3\n");
  const ProcessResult result = offstage({"render", (dir / "bad.toml").string(), "-o", out.string()});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("bad.toml:4:"));
  EXPECT_EQ(readFile(out), "precious");
}

TEST(Commands, HashFileHasALineAFrameAndDoesNotDependOnTheOutput) {
  const TempDir dir;
  const std::filesystem::path a = dir / "a.txt";
  const std::filesystem::path b = dir / "b.txt";
  ASSERT_EQ(offstage({"render", scene("exercise2_bounce"), "--duration", "2", "--hash", a.string()}).status,
            0);
  ASSERT_EQ(offstage({"render", scene("exercise2_bounce"), "--duration", "2", "--hash", b.string(), "-o",
                      (dir / "x.mp4").string()})
                .status,
            0);
  const std::string text = readFile(a);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 120);
  EXPECT_EQ(text, readFile(b));
  std::istringstream lines(text);
  std::string frame;
  std::string state;
  std::string pixels;
  for (int i = 0; i < 120; ++i) {
    lines >> frame >> state >> pixels;
    EXPECT_EQ(frame, std::to_string(i));
    EXPECT_EQ(state.size(), 16U);
    EXPECT_EQ(pixels.size(), 16U);
  }
}

TEST(Commands, PhysicsDoesNotDependOnSizeAndPixelsDo) {
  const TempDir dir;
  const auto hashes = [&](const std::vector<std::string>& extra) {
    std::vector<std::string> arguments{"render", scene("exercise1_bounce"), "--duration", "0.5",
                                       "--hash", (dir / "h.txt").string()};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    EXPECT_EQ(offstage(arguments).status, 0);
    std::istringstream lines(readFile(dir / "h.txt"));
    std::pair<std::string, std::string> all;
    std::string frame;
    std::string state;
    std::string pixels;
    while (lines >> frame >> state >> pixels) {
      all.first += state;
      all.second += pixels;
    }
    return all;
  };
  const auto plain = hashes({});
  const auto large = hashes({"--size", "1280x960"});
  const auto scaled = hashes({"--scale", "2"});
  EXPECT_EQ(plain.first, large.first);
  EXPECT_NE(plain.second, large.second);
  EXPECT_EQ(large.second, scaled.second);
}

TEST(Commands, StillDrawsTheFrameOnShow) {
  const TempDir dir;
  const std::string out = (dir / "still.png").string();
  const ProcessResult result = offstage({"still", scene("fall"), "--at", "1.51", "-o", out});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("still.png: 640x480, frame 90 at 1.5 s"));
  EXPECT_THAT(readFile(out), StartsWith("\x89PNG\r\n\x1a\n"));
}

TEST(Commands, StillNamesWhatSlowMotionShows) {
  const TempDir dir;
  const std::string slow = dir.write("slow.toml", "duration = 2\n[[body]]\ncenter = [100, 100]\nradius = 20\n"
                                                  "[[speed]]\nfrom = 0.5\nto = 1\nfactor = 0.1\n")
                               .string();
  const ProcessResult result = offstage({"still", slow, "--at", "3.02", "-o", dir / "x.png"});
  EXPECT_EQ(result.status, 0) << result.err;
  // 0.5 s and a tenth of the 2.516… s to frame 181 of the video: between frames 45 and 46.
  EXPECT_THAT(result.out, HasSubstr("frame 45 at 0.751"));
}

TEST(Commands, TraceGoesToStdoutByDefaultWithFrame0AndTheLastState) {
  const ProcessResult result = offstage({"trace", scene("fall"), "--duration", "0.1"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out,
              StartsWith("frame,id,time,x,y,vx,vy,radius,group\n0,0,0,123.25,57.5,0,0,20,bodies\n"));
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1 + 7);
}

TEST(Commands, TraceWritesEventsAndJsonLines) {
  const TempDir dir;
  const std::filesystem::path events = dir / "events.csv";
  const std::filesystem::path states = dir / "x.jsonl";
  const ProcessResult result =
      offstage({"trace", scene("exercise1_bounce"), "-o", states.string(), "--events", events.string()});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(readFile(events), StartsWith("frame,event,id1,id2,time,p,q\n"));
  EXPECT_THAT(readFile(events), HasSubstr(",bottom,0,-1,"));
  EXPECT_THAT(readFile(states), StartsWith("{\"frame\":0,\"id\":0,\"time\":0,\"x\":320,"));
}

TEST(Commands, CheckListsEveryErrorOfEveryFile) {
  const TempDir dir;
  writeFile(dir / "a.toml", "durations = 3\n[[body]]\nshape = \"circle\"\ncenter = [1, 2]\nradius = -3\n");
  writeFile(dir / "b.toml", "[clock]\nfps = 0\n");
  const std::string a = (dir / "a.toml").string();
  const std::string b = (dir / "b.toml").string();
  const ProcessResult result = offstage({"check", a, scene("fall"), b});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, scene("fall") + ": ok\n");
  EXPECT_THAT(result.err, HasSubstr(a + ":1:1: error: "));
  EXPECT_THAT(result.err, HasSubstr("duration"));
  EXPECT_THAT(result.err, HasSubstr(a + ":5:"));
  EXPECT_THAT(result.err, HasSubstr(b + ":2:"));
}

TEST(Commands, CheckDecodesImages) {
  const TempDir dir;
  writeFile(dir / "broken.png", "this is no picture");
  writeFile(dir / "a.toml",
            "[[body]]\nshape = \"circle\"\ncenter = [1, 2]\nradius = 3\nfill = { image = \"broken.png\" }\n");
  const ProcessResult result = offstage({"check", (dir / "a.toml").string()});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("a.toml:5:"));
  EXPECT_THAT(result.err, HasSubstr("broken.png"));
}

TEST(Commands, CheckLooksAtTheMasksOfGoldens) {
  const TempDir dir;
  writeFile(dir / "text.png", "this is no picture");
  ASSERT_EQ(
      offstage({"still", scene("fall"), "--at", "0", "--size", "32x24", "-o", dir / "small.png"}).status, 0);
  const std::string start = "[[body]]\ncenter = [1, 2]\nradius = 3\n[golden]\nat = [1]\nmask = ";
  for (const auto& [mask, problem] :
       {std::pair{"\"nope.png\"",
                  "s.toml:6:8: error: 'mask' names the file \"nope.png\", which does not exist"},
        {"[\".\"]", "s.toml:6:9: error: 'mask' names the file \".\", which is no regular file"},
        {"\"text.png\"", "text.png"},
        {"\"small.png\"", "is 32x24 px, the pictures are 640x480"}}) {
    writeFile(dir / "s.toml", start + mask + "\n");
    const ProcessResult result = offstage({"check", dir / "s.toml"});
    EXPECT_EQ(result.status, 2) << mask;
    EXPECT_THAT(result.err, HasSubstr(problem)) << mask;
  }
}

TEST(Commands, CheckGoesOnBehindASceneThatThisMachineCannotDraw) {
  const TempDir dir;
  writeFile(dir / "formula.toml", "[[text]]\nformula = 'x'\nplace = \"top\"\n");
  writeFile(dir / "wrong.toml", "[clock]\nfps = 0\n");
  ProcessOptions options;
  options.environment = {{"XDG_CACHE_HOME", dir.path().string()}, {"PATH", ""}};
  const ProcessResult lacking = offstage({"check", dir / "formula.toml", scene("fall")}, options);
  EXPECT_EQ(lacking.status, 3);
  EXPECT_EQ(lacking.out, scene("fall") + ": ok\n");
  EXPECT_THAT(lacking.err, HasSubstr("formula.toml: error: a formula is typeset by latex, which is missing"));
  const ProcessResult both = offstage({"check", dir / "formula.toml", dir / "wrong.toml"}, options);
  EXPECT_EQ(both.status, 2);
  EXPECT_THAT(both.err, HasSubstr("wrong.toml:2:"));
  EXPECT_THAT(offstage({"check", "--json", dir / "formula.toml"}, options).out,
              HasSubstr("\"ok\": false, \"errors\": ["));
}

TEST(Commands, CheckAsJson) {
  const TempDir dir;
  writeFile(dir / "b.toml", "[clock]\nfps = 0\n");
  const ProcessResult result = offstage({"check", "--json", scene("fall"), (dir / "b.toml").string()});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("\"ok\": true, \"errors\": []}"));
  EXPECT_THAT(result.out, HasSubstr("\"line\": 2, \"column\": "));
}

TEST(Commands, DoctorFindsEverythingThatTheBuildInstalled) {
  const ProcessResult result = offstage({"doctor"});
  EXPECT_EQ(result.status, 0) << result.out;
  EXPECT_THAT(result.out, HasSubstr("GL           ok: osmesa"));
  EXPECT_THAT(result.out, HasSubstr("ok: libx264"));
}

TEST(Commands, AGraphicsProcessorDrawsWithinOneOf255OrIsSaidToBeMissing) {
  const TempDir dir;
  ProcessOptions options;
  options.environment = {{"OFFSTAGE_GL", "egl-device"}};
  const std::string device = dir / "device.png";
  const ProcessResult result = offstage({"still", scene("shapes"), "--at", "0.5", "-o", device}, options);
  if (result.status == 3) { // no such processor here
    EXPECT_NE(result.err.find("OFFSTAGE_GL=egl-device finds nothing to draw with"), std::string::npos)
        << result.err;
    EXPECT_FALSE(std::filesystem::exists(device));
    return;
  }
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string software = dir / "software.png";
  ASSERT_EQ(offstage({"still", scene("shapes"), "--at", "0.5", "-o", software}).status, 0);
  const Image a = loadImage(device);
  const Image b = loadImage(software);
  ASSERT_EQ(a.rgba.size(), b.rgba.size());
  int worst = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) worst = std::max(worst, std::abs(a.rgba[i] - b.rgba[i]));
  EXPECT_LE(worst, 1);
  EXPECT_NE(offstage({"doctor"}, options).out.find("egl-device"), std::string::npos);
}

TEST(Commands, ProgramsInCppMoveAndLookExactlyAsTheirScenes) {
  const TempDir dir;
  for (const std::string name : {"fall", "exercise1_bounce", "spawn", "exercise2_spawn_bounce",
                                 "exercise2_vanish", "exercise2_bounce", "projectiles"}) {
    const std::filesystem::path ofScene = dir / "scene.txt";
    const std::filesystem::path ofProgram = dir / "program.txt";
    ASSERT_EQ(offstage({"render", scene(name), "--hash", ofScene.string()}).status, 0);
    const ProcessResult result =
        runProcess({OFFSTAGE_BINARY_DIR "/programs/" + name, "--hash", ofProgram.string()});
    ASSERT_EQ(result.status, 0) << result.err;
    std::istringstream expected(readFile(ofScene));
    std::istringstream actual(readFile(ofProgram));
    std::string expectedLine;
    std::string actualLine;
    while (std::getline(expected, expectedLine)) {
      ASSERT_TRUE(std::getline(actual, actualLine)) << name << " ends before " << expectedLine;
      ASSERT_EQ(actualLine, expectedLine) << name;
    }
    EXPECT_FALSE(std::getline(actual, actualLine)) << name << " goes on with " << actualLine;
  }
}

} // namespace
} // namespace offstage::test
