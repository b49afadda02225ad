#include "tests/support/process.h"
#include "tests/support/running.h"
#include "tests/support/temp_dir.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <climits>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A render of four chunks of 150 frames that takes a second or two of processor time.
std::vector<std::string> renderTo(const std::string& out, const std::vector<std::string>& extra = {},
                                  const std::string& duration = "10") {
  std::vector<std::string> arguments{program(), "render", scene("exercise2_bounce"), "--duration", duration,
                                     "-o",      out};
  arguments.insert(arguments.end(), extra.begin(), extra.end());
  return arguments;
}

std::string bytesOf(const std::vector<std::string>& command, const std::filesystem::path& out) {
  const ProcessResult result = runProcess(command);
  EXPECT_EQ(result.status, 0) << result.err;
  std::string bytes = readFile(out);
  std::filesystem::remove(out);
  return bytes;
}

TEST(Resume, BytesDoNotDependOnTheNumberOfWorkers) {
  const TempDir dir;
  const std::filesystem::path hashes = dir / "h.txt";
  struct Case {
    std::string name;
    std::string duration; ///< s
  };
  for (const Case& made : {Case{"x.mp4", "10"}, {"x.webm", "2"}, {"x.gif", "2"}, {"x.apng", "2"}}) {
    const std::string& name = made.name;
    const auto with = [&](const std::string& jobs) {
      const std::vector<std::string> extra{"--size", "320x240", "--hash", hashes.string(), "--jobs", jobs};
      return bytesOf(renderTo(dir / name, extra, made.duration), dir / name);
    };
    const std::string expected = with("0");
    const std::string lines = readFile(hashes);
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 60 * std::stoi(made.duration));
    for (const std::string jobs : {"1", "2", "5"}) {
      EXPECT_TRUE(with(jobs) == expected) << name << " with " << jobs << " workers";
      EXPECT_EQ(readFile(hashes), lines) << name << " with " << jobs << " workers";
    }
    EXPECT_THAT(dir.names(), ElementsAre("h.txt"));
  }
}

TEST(Resume, EglGivesTheSameBytes) {
  const TempDir dir;
  const std::string expected = bytesOf(renderTo(dir / "x.mp4"), dir / "x.mp4");
  ProcessOptions egl;
  egl.environment = {{"OFFSTAGE_GL", "egl"}};
  const ProcessResult result = runProcess(renderTo(dir / "x.mp4"), egl);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(readFile(dir / "x.mp4") == expected);
}

TEST(Resume, KilledTenTimesItMakesTheSameFile) {
  const TempDir dir;
  const std::vector<std::string> command = renderTo(dir / "x.mp4", {"--jobs", "2", "--size", "1280x960"});
  const std::string expected = bytesOf(command, dir / "x.mp4");
  std::mt19937 random(2022);
  for (int kills = 0; kills < 10;) {
    writeFile(dir / "x.mp4", "precious");
    Running run(command);
    if (run.wait(static_cast<int>(20 + random() % 300))) { // it was faster: the next one starts from nothing
      EXPECT_EQ(run.finish(), 0) << run.errors();
      EXPECT_TRUE(readFile(dir / "x.mp4") == expected);
      continue;
    }
    run.signal(SIGKILL);
    run.waitForAll();
    ++kills;
    // Killed right after it has put the file under its name, it has only not tidied up.
    const std::string there = readFile(dir / "x.mp4");
    EXPECT_TRUE(there == "precious" || there == expected) << "after kill " << kills;
  }
  const ProcessResult last = runProcess(command);
  EXPECT_EQ(last.status, 0) << last.err;
  EXPECT_TRUE(readFile(dir / "x.mp4") == expected);
  // A process that is killed while it joins cannot remove its hidden temporary file beside OUT.
  EXPECT_FALSE(std::filesystem::exists(dir / "x.mp4.parts"));
}

TEST(Resume, GoesOnFromFinishedChunksAndSaysSo) {
  const TempDir dir;
  const std::string expected = bytesOf(renderTo(dir / "x.mp4"), dir / "x.mp4");
  Running run(renderTo(dir / "x.mp4", {"--jobs", "1"}));
  ASSERT_TRUE(run.waitUntil([&] { return std::filesystem::exists(dir / "x.mp4.parts/000001.chunk"); }));
  run.signal(SIGKILL);
  run.waitForAll();
  EXPECT_FALSE(std::filesystem::exists(dir / "x.mp4"));
  const ProcessResult second = runProcess(renderTo(dir / "x.mp4"));
  EXPECT_EQ(second.status, 0);
  EXPECT_THAT(second.err, AllOf(HasSubstr("going on with "), HasSubstr("of 4 chunks from '")));
  EXPECT_TRUE(readFile(dir / "x.mp4") == expected);
  EXPECT_THAT(dir.names(), ElementsAre("x.mp4"));
}

TEST(Resume, WorkersThatAreKilledAreStartedAgain) {
  const TempDir dir;
  const std::string expected = bytesOf(renderTo(dir / "x.mp4"), dir / "x.mp4");
  Running run(renderTo(dir / "x.mp4", {"--jobs", "2"}));
  int killed = 0;
  while (!run.wait(30) && killed < 3) {
    // The run's child simulates; that one's children are the workers.
    for (const int simulator : childrenOf(run.id()))
      for (const int worker : childrenOf(simulator))
        if (killed < 3 && kill(worker, SIGKILL) == 0) ++killed;
  }
  EXPECT_EQ(killed, 3);
  EXPECT_EQ(run.finish(), 0);
  EXPECT_TRUE(readFile(dir / "x.mp4") == expected);
  EXPECT_THAT(dir.names(), ElementsAre("x.mp4"));
}

TEST(Resume, KilledWorkersLeaveNothingAmongThePictures) {
  const TempDir dir;
  std::filesystem::create_directory(dir / "f");
  Running run(renderTo(dir / "f/%04d.png", {"--jobs", "2", "--size", "1280x960"}));
  ASSERT_TRUE(run.waitUntil([&] { return dir.names("f").size() > 40; }));
  int killed = 0;
  for (const int simulator : childrenOf(run.id()))
    for (const int worker : childrenOf(simulator)) killed += kill(worker, SIGKILL) == 0 ? 1 : 0;
  EXPECT_GT(killed, 0);
  EXPECT_EQ(run.finish(), 0) << run.errors();
  EXPECT_EQ(dir.names("f").size(), 600U);
  for (const std::string& name : dir.names("f")) EXPECT_FALSE(name.starts_with('.')) << name;
}

TEST(Resume, TheSimulatingProcessIsStartedAgainToo) {
  const TempDir dir;
  const std::string expected = bytesOf(renderTo(dir / "x.mp4"), dir / "x.mp4");
  Running run(renderTo(dir / "x.mp4", {"--jobs", "2"}));
  ASSERT_TRUE(run.waitUntil([&] { return !childrenOf(run.id()).empty(); }));
  for (const int simulator : childrenOf(run.id())) kill(simulator, SIGKILL);
  EXPECT_EQ(run.finish(), 0);
  EXPECT_TRUE(readFile(dir / "x.mp4") == expected);
}

TEST(Resume, AWorkerThatAlwaysDiesIsTransientNotForEver) {
  const TempDir dir;
  Running run(renderTo(dir / "x.mp4", {"--jobs", "1"}));
  while (!run.wait(5)) {
    for (const int simulator : childrenOf(run.id()))
      for (const int worker : childrenOf(simulator)) kill(worker, SIGKILL);
  }
  EXPECT_EQ(run.finish(), 75);
  EXPECT_FALSE(std::filesystem::exists(dir / "x.mp4"));
}

TEST(Resume, WorkersEndWithTheirParent) {
  const TempDir dir;
  Running run(renderTo(dir / "x.mp4", {"--jobs", "2"}));
  std::vector<int> workers;
  ASSERT_TRUE(run.waitUntil([&] {
    for (const int simulator : childrenOf(run.id())) workers = childrenOf(simulator);
    return workers.size() == 2;
  }));
  run.signal(SIGKILL);
  run.waitForAll();
  // The kernel ends a process a moment after it has closed its files.
  for (int i = 0; i < 2000 && std::ranges::any_of(workers, isRunning); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  for (const int worker : workers) EXPECT_FALSE(isRunning(worker)) << "worker " << worker << " lives on";
}

TEST(Resume, AnotherSceneOrOptionStartsOverAndSaysSo) {
  const TempDir dir;
  const auto interrupted = [&](const std::vector<std::string>& extra) {
    Running run(renderTo(dir / "x.mp4", extra));
    EXPECT_TRUE(run.waitUntil([&] { return std::filesystem::exists(dir / "x.mp4.parts/000000.chunk"); }));
    run.signal(SIGKILL);
    run.waitForAll();
  };
  interrupted({"--jobs", "1"});
  const ProcessResult other = runProcess(renderTo(dir / "x.mp4", {"--seed", "7"}));
  EXPECT_EQ(other.status, 0);
  EXPECT_THAT(other.err, AllOf(HasSubstr("starting over: "), HasSubstr("the options")));
  interrupted({"--jobs", "1"});
  const ProcessResult fresh = runProcess(renderTo(dir / "x.mp4", {"--no-resume"}));
  EXPECT_EQ(fresh.status, 0);
  EXPECT_EQ(fresh.err, "");
}

TEST(Resume, WhatAKilledRunLeftBesideTheOutputIsRemoved) {
  const TempDir dir;
  std::filesystem::create_directory(dir / "f");
  std::vector<std::filesystem::path> left{dir.write(".x.mp4.4194305.partial", "cut off"),
                                          dir.write("f/.0003.png.4194305.partial", "cut off")};
  // Names of 250 bytes, of which a temporary holds only the beginning.
  const std::string longest(246, 'n');
  for (const std::string& name : {longest, longest.substr(0, 150) + "000" + longest.substr(0, 93)}) {
    const std::string ending = ".4194305.partial";
    left.push_back(dir.write("." + name.substr(0, NAME_MAX - 1 - ending.size()) + ending, "cut off"));
  }
  for (const std::string& out : {std::string("x.mp4"), std::string("f/%04d.png"), longest + ".mp4",
                                 longest.substr(0, 150) + "%03d" + longest.substr(0, 93) + ".png"}) {
    const ProcessResult result = runProcess(renderTo(dir / out, {"--size", "64x48"}, "0.2"));
    EXPECT_EQ(result.status, 0) << result.err;
  }
  for (const std::filesystem::path& file : left) EXPECT_FALSE(std::filesystem::exists(file)) << file;
}

TEST(Resume, CtrlCKeepsFinishedChunksAndTellsOfThem) {
  const TempDir dir;
  Running run(renderTo(dir / "x.mp4", {"--jobs", "1"}));
  ASSERT_TRUE(run.waitUntil([&] { return std::filesystem::exists(dir / "x.mp4.parts/000000.chunk"); }));
  run.signal(SIGINT);
  EXPECT_EQ(run.finish(), 130);
  EXPECT_THAT(run.errors(), AllOf(HasSubstr("interrupted"), HasSubstr("of 4 chunks are kept in")));
  EXPECT_THAT(dir.names(), ElementsAre("x.mp4.parts"));
  for (const std::string& name : dir.names("x.mp4.parts")) EXPECT_FALSE(name.starts_with('.')) << name;
}

TEST(Resume, AnIgnoredCtrlCStaysIgnored) {
  const TempDir dir;
  std::vector<std::string> command{"sh", "-c", "trap '' INT; exec \"$@\"", "sh"};
  for (const std::string& argument : renderTo(dir / "x.mp4", {"--jobs", "1"})) command.push_back(argument);
  Running run(command);
  ASSERT_TRUE(run.waitUntil([&] { return std::filesystem::exists(dir / "x.mp4.parts/000000.chunk"); }));
  run.signal(SIGINT);
  EXPECT_EQ(run.finish(), 0) << run.errors();
  EXPECT_THAT(dir.names(), ElementsAre("x.mp4"));
}

/// A short render under a limit of the shell's.
ProcessResult renderWithin(const std::string& limit, const std::filesystem::path& out) {
  std::vector<std::string> command{"sh", "-c", limit + "; exec \"$@\"", "sh"};
  for (const std::string& argument : renderTo(out, {"--jobs", "1"}, "0.2")) command.push_back(argument);
  return runProcess(command);
}

TEST(Resume, AStartWithTooFewOpenFilesLeavesNothing) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "UndefinedBehaviorSanitizer looks at memory through a pipe";
#endif
  constexpr int kNotLoaded = 127; // not even the program's own libraries
  int failed = 0;
  // How many are open already is up to who runs the test.
  for (int files = 4; files < 40; ++files) {
    const TempDir dir;
    const ProcessResult result = renderWithin("ulimit -n " + std::to_string(files), dir / "x.mp4");
    if (result.status == 0) break;
    EXPECT_THAT(dir.names(), IsEmpty()) << files << ": " << result.err;
    if (result.status == kNotLoaded) continue;
    EXPECT_EQ(result.status, 75) << files << ": " << result.err;
    EXPECT_THAT(result.err, HasSubstr("Too many open files")) << files;
    ++failed;
  }
  EXPECT_GT(failed, 0);
}

TEST(Resume, AStartWithTooLittleAddressSpaceSaysSo) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "AddressSanitizer reserves terabytes";
#endif
  const TempDir dir;
  const ProcessResult result = renderWithin("ulimit -v 200000", dir / "x.mp4");
  EXPECT_EQ(result.status, 75);
  EXPECT_THAT(result.err, HasSubstr("there is no memory to load"));
  EXPECT_THAT(dir.names(), IsEmpty());
}

TEST(Resume, TwoRunsOnOneOutputDoNotDisturbEachOther) {
  const TempDir dir;
  Running run(renderTo(dir / "x.mp4", {"--jobs", "1", "--size", "1280x960"}));
  ASSERT_TRUE(run.waitUntil([&] { return std::filesystem::exists(dir / "x.mp4.parts/manifest"); }));
  const ProcessResult second = runProcess(renderTo(dir / "x.mp4"));
  EXPECT_EQ(second.status, 75);
  EXPECT_THAT(second.err, HasSubstr("another run is making this output"));
  EXPECT_EQ(run.finish(), 0) << run.errors();
  EXPECT_THAT(dir.names(), ElementsAre("x.mp4"));
}

TEST(Resume, AFullDiskKeepsWhatIsThere) {
  const TempDir dir;
  writeFile(dir / "x.mp4", "precious");
  // No file may grow past 8 KiB: the manifest fits, a chunk does not.
  const ProcessResult full =
      runProcess({"/bin/sh", "-c", "ulimit -f 8; exec \"$@\"", "sh", program(), "render",
                  scene("exercise2_bounce"), "--size", "960x720", "-o", dir / "x.mp4"});
  EXPECT_EQ(full.status, 75) << full.err;
  EXPECT_THAT(full.err, HasSubstr("largest size"));
  EXPECT_EQ(readFile(dir / "x.mp4"), "precious");
  EXPECT_THAT(dir.names(), ElementsAre("x.mp4"));
}

TEST(Resume, PicturesOfASequenceAreKeptToo) {
  const TempDir dir;
  Running run(renderTo(dir / "f/%04d.png", {"--jobs", "1", "--size", "320x240"}));
  ASSERT_TRUE(run.waitUntil([&] { return std::filesystem::exists(dir / "f/%04d.png.parts/000000.chunk"); }));
  run.signal(SIGKILL);
  run.waitForAll();
  std::filesystem::remove(dir / "f/0003.png"); // of the finished chunk
  const ProcessResult second = runProcess(renderTo(dir / "f/%04d.png", {"--size", "320x240"}));
  EXPECT_EQ(second.status, 0) << second.err;
  EXPECT_EQ(dir.names("f").size(), 600U);
  EXPECT_TRUE(std::filesystem::exists(dir / "f/0003.png"));
}

TEST(Segments, JoinToTheBytesOfAWholeRender) {
  const TempDir dir;
  for (const std::string name : {"x.mp4", "x.gif", "x.apng"}) {
    const std::vector<std::string> options{"--size", "160x120", "--fps", "50"};
    const std::string expected = bytesOf(renderTo(dir / name, options), dir / name);
    for (const std::string segment : {"2/3", "1/3", "3/3"}) {
      std::vector<std::string> extra = options;
      extra.insert(extra.end(), {"--segment", segment});
      const ProcessResult part = runProcess(renderTo(dir / name, extra));
      EXPECT_EQ(part.status, 0) << part.err;
      EXPECT_THAT(part.out, HasSubstr("segment " + segment.substr(0, 1) + " of 3"));
      EXPECT_FALSE(std::filesystem::exists(dir / name));
    }
    const ProcessResult joined = offstage({"join", "-o", dir / name, scene("exercise2_bounce")});
    EXPECT_EQ(joined.status, 0) << joined.err;
    EXPECT_TRUE(readFile(dir / name) == expected) << name;
    std::filesystem::remove(dir / name);
    EXPECT_THAT(dir.names(), IsEmpty());
  }
}

TEST(Segments, JoinRefusesWhatDoesNotFit) {
  const TempDir dir;
  const std::string out = dir / "x.mp4";
  ProcessResult none = offstage({"join", "-o", out, scene("exercise2_bounce")});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("render the segments first"));
  ASSERT_EQ(runProcess(renderTo(out, {"--size", "64x48", "--segment", "1/2"})).status, 0);
  none = offstage({"join", "-o", out, scene("exercise2_bounce")});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("lacks 2 of 4 chunks, the first that of frames 300 to 449"));
  ASSERT_EQ(runProcess(renderTo(out, {"--size", "64x48", "--segment", "2/2"})).status, 0);
  const ProcessResult otherScene = offstage({"join", "-o", out, scene("fall")});
  EXPECT_EQ(otherScene.status, 2);
  EXPECT_THAT(otherScene.err, HasSubstr("made from something else"));
  const ProcessResult otherOption = offstage({"join", "-o", out, scene("exercise2_bounce"), "--seed", "3"});
  EXPECT_EQ(otherOption.status, 2);
  EXPECT_THAT(otherOption.err, HasSubstr("the options"));
  EXPECT_EQ(offstage({"join", "-o", out, scene("exercise2_bounce"), "--duration", "10"}).status, 0);
  EXPECT_THAT(dir.names(), ElementsAre("x.mp4"));
}

TEST(Segments, BadOnesAreRefused) {
  const TempDir dir;
  for (const std::string segment : {"0/2", "3/2", "1", "1/", "/2", "a/b", "-1/2", "1/0", "1/2x"}) {
    const ProcessResult result = runProcess(renderTo(dir / "x.mp4", {"--segment", segment}));
    EXPECT_EQ(result.status, 2) << segment;
    EXPECT_THAT(result.err, HasSubstr("--segment '" + segment + "'"));
  }
  const ProcessResult raw = runProcess(renderTo(dir / "x.raw", {"--segment", "1/2"}));
  EXPECT_EQ(raw.status, 2);
  EXPECT_THAT(dir.names(), IsEmpty());
}

TEST(Segments, ThereMayBeMoreThanChunks) {
  const TempDir dir;
  const std::string expected = bytesOf(renderTo(dir / "x.mp4"), dir / "x.mp4");
  int empty = 0;
  for (int number = 1; number <= 9; ++number) {
    const ProcessResult result =
        runProcess(renderTo(dir / "x.mp4", {"--segment", std::to_string(number) + "/9"}));
    EXPECT_EQ(result.status, 0) << number << result.err;
    const bool none = result.err.find("has nothing to make: the output has 4 chunks") != std::string::npos;
    EXPECT_EQ(none, result.out.find(": 0 frames, 0.000 s") != std::string::npos) << result.out;
    empty += none ? 1 : 0;
  }
  EXPECT_EQ(empty, 5);
  EXPECT_EQ(offstage({"join", "-o", dir / "x.mp4", scene("exercise2_bounce")}).status, 0);
  EXPECT_TRUE(readFile(dir / "x.mp4") == expected);
}

TEST(Segments, SegmentsMayRunAtTheSameTime) {
  const TempDir dir;
  const std::string expected = bytesOf(renderTo(dir / "x.mp4"), dir / "x.mp4");
  Running first(renderTo(dir / "x.mp4", {"--segment", "1/2", "--jobs", "1"}));
  Running second(renderTo(dir / "x.mp4", {"--segment", "2/2", "--jobs", "1"}));
  EXPECT_EQ(first.finish(), 0) << first.errors();
  EXPECT_EQ(second.finish(), 0) << second.errors();
  EXPECT_EQ(offstage({"join", "-o", dir / "x.mp4", scene("exercise2_bounce")}).status, 0);
  EXPECT_TRUE(readFile(dir / "x.mp4") == expected);
}

} // namespace
} // namespace offstage::test
