#include "render/job/rehearsal.h"
#include "render/job/warning_log.h"
#include "render/stage/exercise.h"
#include "render/stage/stage_source.h"
#include "tests/support/golden_folder.h"
#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// A shot goes through its target in the step to frame 300, in the second chunk of 240 frames.
constexpr const char* kTunnel = R"(
duration = 10.0
[frame]
size = [96, 48]
[world]
gravity = [0, 0]
[[body]]
group = "targets"
center = [48, 24]
radius = 2
[[launch]]
frame = 300
from = [10, 24]
toward = [90, 24]
speed = 4800
radius = 2
[[collide]]
between = ["shots", "targets"]
)";

/// The same, but nothing to tell: the shot is slow.
std::string quiet() {
  std::string text = kTunnel;
  return text.replace(text.find("4800"), 4, "60");
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

const std::string kSays =
    "warning: frame 300 (5 s), body 1 of \"shots\": it went through body 0 in one step without touching it: "
    "80 "
    "px, where both together are 8 px wide; continuous = true on one of them makes its whole way count, or "
    "[clock] substeps = 21 shortens the steps [crossing]\n";

class Warned : public ::testing::Test {
protected:
  Warned() : file_(dir_.write("shot.toml", kTunnel)) {}
  ProcessResult run(std::vector<std::string> arguments) const {
    return offstage(std::move(arguments), {.environment = {}, .directory = dir_.path()});
  }
  TempDir dir_;
  std::filesystem::path file_;
};

TEST_F(Warned, EveryVerbThatSimulatesSaysItOnceAndGoesOn) {
  for (const char* jobs : {"0", "1", "3"}) {
    const ProcessResult render =
        run({"render", "shot.toml", "-o", "x.mp4", "--poster", "x.png", "--jobs", jobs, "--hash", "h.txt"});
    EXPECT_EQ(render.status, 0);
    EXPECT_EQ(render.err, "shot.toml: " + kSays) << jobs;
  }
  const ProcessResult raw = run({"render", "shot.toml", "-o", "x.raw"});
  EXPECT_EQ(raw.err, "shot.toml: " + kSays);
  const ProcessResult still = run({"still", "shot.toml", "--at", "6", "-o", "s.png"});
  EXPECT_EQ(still.err, "shot.toml: " + kSays);
  EXPECT_EQ(run({"still", "shot.toml", "--at", "4.9", "-o", "s.png"}).err, "");
  const ProcessResult trace = run({"trace", "shot.toml", "-o", "t.csv"});
  EXPECT_EQ(trace.status, 0);
  EXPECT_EQ(trace.err, "shot.toml: " + kSays);
  EXPECT_EQ(count(run({"trace", "shot.toml", "--summary"}).err, "warning"), 1U);
  const ProcessResult bundle = run({"bundle", "shot.toml", "-o", "b"});
  EXPECT_EQ(bundle.status, 0) << bundle.err;
  EXPECT_EQ(count(bundle.err, "warning"), 1U) << bundle.err;
}

TEST_F(Warned, StrictMakesNothingAndLeavesWhatIsThere) {
  const std::vector<std::vector<std::string>> commands{
      {"render", "shot.toml", "-o", "x.mp4", "--strict"},
      {"render", "shot.toml", "-o", "x.mp4", "--strict", "--jobs", "0"},
      {"render", "shot.toml", "-o", "x.mp4", "--strict", "--segment", "1/2"},
      {"render", "shot.toml", "-o", "x.raw", "--strict"},
      {"render", "shot.toml", "-o", "x%03d.png", "--strict"},
      {"render", "shot.toml", "--hash", "x.txt", "--strict"},
      {"render", "shot.toml", "--poster", "x.png", "--from", "4.9", "--strict"}, // the middle of what is left
      {"still", "shot.toml", "--at", "6", "-o", "x.png", "--strict"},
      {"trace", "shot.toml", "-o", "x.csv", "--events", "x.jsonl", "--strict"},
      {"trace", "shot.toml", "-o", "-",
       "--strict"}, // rows of 300 frames stood in the pipe before the warning
      {"trace", "shot.toml", "--events", "-", "-o", "x.csv", "--strict"},
      {"trace", "shot.toml", "--summary", "--strict"},
      {"bundle", "shot.toml", "-o", "b", "--strict"},
      {"bundle", "shot.toml", "-o", "b", "--to", "1", "--strict"}};
  for (const char* name : {"x.mp4", "x.raw", "x000.png", "x.txt", "x.png", "x.csv", "x.jsonl"})
    dir_.write(name, "mine");
  std::filesystem::create_directory(dir_ / "b");
  const std::vector<std::string> before = dir_.names();
  for (const auto& command : commands) {
    const ProcessResult result = run(command);
    EXPECT_EQ(result.status, 2) << command[0] << ' ' << command[3];
    EXPECT_THAT(result.err, AllOf(StartsWith("shot.toml: error: frame 300 (5 s), body 1 of \"shots\": "),
                                  EndsWith("[crossing] (--strict)\n")));
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(dir_.names(), before) << command[0] << ' ' << command[3];
    EXPECT_THAT(dir_.names("b"), IsEmpty());
  }
  for (const char* name : {"x.mp4", "x.raw", "x000.png", "x.txt", "x.png", "x.csv", "x.jsonl"})
    EXPECT_EQ(readFile(dir_ / name), "mine") << name;
}

TEST_F(Warned, StrictLooksAsFarAsWhatIsMade) {
  EXPECT_EQ(run({"render", "shot.toml", "-o", "x.mp4", "--to", "4.9", "--strict"}).status, 0);
  EXPECT_EQ(run({"still", "shot.toml", "--at", "4.9", "-o", "x.png", "--strict"}).status, 0);
  // The poster shows the middle of that, or what the scene says.
  const std::vector<std::string> poster{"render", "shot.toml", "-o",    "x.mp4",   "--to",
                                        "4.9",    "--poster",  "x.png", "--strict"};
  EXPECT_EQ(run(poster).status, 0);
  dir_.write("shot.toml", std::string(kTunnel) + "[poster]\nat = 5\n");
  EXPECT_EQ(run(poster).status, 2);
  dir_.write("shot.toml", quiet());
  const ProcessResult clean = run({"render", "shot.toml", "-o", "y.mp4", "--strict"});
  EXPECT_EQ(clean.status, 0);
  EXPECT_EQ(clean.err, "");
}

TEST_F(Warned, WhatASceneIsMeantToShowIsNoWarning) {
  std::string text = kTunnel;
  dir_.write("shot.toml", text.replace(text.find("gravity"), 0, "expect = [\"crossing\"]\n"));
  const ProcessResult trace = run({"trace", "shot.toml", "-o", "t.csv", "--strict"});
  EXPECT_EQ(trace.status, 0);
  EXPECT_EQ(trace.err, "");
}

/// The same in a world of the contact solver.
std::string solved(const std::string& keys, const std::string& clock) {
  std::string text = kTunnel;
  text.replace(text.find("gravity"), 0, "contacts = \"solver\"\n");
  return text.replace(text.find("speed"), 0, keys + "\n") + "[clock]\n" + clock + "\n";
}

TEST_F(Warned, TheContactSolverIsHelpedByWhatTheWarningAdvises) {
  const auto traced = [&](const std::string& keys, const std::string& clock) {
    dir_.write("shot.toml", solved(keys, clock));
    return run({"trace", "shot.toml", "-o", "t.csv", "--events", "-"});
  };
  const std::string says =
      "shot.toml: warning: frame 300 (5 s), body 1 of \"shots\": it went through body 0 in one step without "
      "touching it: 80 px, where both together are 8 px wide; the contact solver looks for contacts once a "
      "step, whatever its substeps: continuous = true on one of them makes its whole way count, or [clock] ";
  const std::string shorter = " shortens the steps [crossing]\n";
  EXPECT_EQ(traced("", "").err, says + "step = \"clamped\" with dt = 0.000794" + shorter); // (1/60)/21
  EXPECT_EQ(traced("", "substeps = 21").err, says + "step = \"clamped\" with dt = 0.000794" + shorter)
      << "the lecture's advice is none here";
  EXPECT_EQ(traced("", "step = \"accumulator\"").err, says + "dt = 0.000794" + shorter);

  const std::vector<std::pair<const char*, const char*>> advice{
      {"continuous = true", ""},
      {"", "step = \"clamped\"\ndt = 0.000794"},
      {"", "step = \"accumulator\"\ndt = 0.000794"}};
  for (const auto& [keys, clock] : advice) {
    const ProcessResult followed = traced(keys, clock);
    EXPECT_EQ(followed.err, "") << keys << clock;
    EXPECT_EQ(count(followed.out, "collide"), 1U) << keys << clock << '\n' << followed.out;
  }
}

TEST_F(Warned, BodiesThatTheContactSolverThrowsApartAreToldToBeginApart) {
  std::string scene = "duration = 0.1\n[world]\ngravity = [0, 0]\ncontacts = \"solver\"\n"
                      "[[collide]]\nbetween = [\"bodies\", \"bodies\"]\n";
  for (int i = 0; i < 10; ++i)
    scene += "[[body]]\nradius = 10\ncenter = [" + std::to_string(200 + 3 * (i % 4)) + ", " +
             std::to_string(200 + 3 * (i / 4)) + "]\n";
  dir_.write("heap.toml", scene);
  const std::string err = run({"trace", "heap.toml", "--summary"}).err;
  EXPECT_THAT(err,
              HasSubstr("shorter steps ([clock] substeps) help, but not where bodies overlap when they "
                        "come: the contact solver throws those apart, so let them begin apart [energy]"));
}

TEST_F(Warned, ASlideThatPushesThroughAnEdgeOfTheContactSolverIsToldSo) {
  const auto traced = [&](const char* response) {
    dir_.write("pushed.toml", std::string(R"(
duration = 0.2
[frame]
size = [96, 48]
[world]
gravity = [0, 0]
contacts = "solver"
[walls]
all = 1
[[body]]
group = "rock"
center = [48, 30]
radius = 30
fixed = true
[[body]]
center = [48, 42]
radius = 4
velocity = [0, 30]
[[collide]]
between = ["rock", "bodies"]
response = )") + response + "\n");
    return run({"trace", "pushed.toml", "-o", "t.csv"}).err;
  };
  EXPECT_THAT(
      traced("\"slide\"\nseparate = true\napproaching_only = false"),
      HasSubstr("it went through the pane's lower edge and is behind it; a \"slide\" pushes it after the "
                "walls have held it: response = \"bounce\" does not [crossing]\n"));
  EXPECT_EQ(traced("\"bounce\""), "");
}

TEST_F(Warned, APanelIsNamedAndTheSceneItselfIsNotWatched) {
  dir_.write("shot.toml", quiet() +
                              "[[panel]]\ntitle = \"slow\"\n[[panel]]\ntitle = \"fast\"\n[[panel.launch]]\n"
                              "frame = 300\nfrom = [10, 24]\ntoward = [90, 24]\nspeed = 4800\nradius = 2\n");
  const ProcessResult still = run({"still", "shot.toml", "--at", "6", "-o", "s.png"});
  EXPECT_THAT(still.err, StartsWith("shot.toml: warning: panel \"fast\", frame 300 (5 s), body 1"));
  EXPECT_EQ(count(still.err, "warning"), 1U);
  EXPECT_EQ(run({"trace", "shot.toml", "-o", "t.csv"}).err, "")
      << "a trace is of the scene without its panels";
}

TEST_F(Warned, GoldensOfAStrictRunAreNotTouched) {
  const TempDir goldens;
  dir_.write("shot.toml", std::string(kTunnel) + "[golden]\nat = [1, 6]\n");
  dir_.write("calm.toml", quiet() + "[golden]\nat = [1]\n");
  const std::string store = (goldens / "store").string();
  const ProcessResult strict = run({"golden", "record", store, "--scenes", ".", "--strict"});
  EXPECT_EQ(strict.status, 2);
  EXPECT_THAT(strict.err, HasSubstr("shot.toml: error: frame 300"));
  EXPECT_FALSE(std::filesystem::exists(store));
  const ProcessResult told = run({"golden", "record", store, "--scenes", "."});
  EXPECT_EQ(told.status, 0);
  EXPECT_EQ(count(told.err, "warning"), 1U);
  const ProcessResult verified = run({"golden", "verify", store, "--scenes", ".", "--strict"});
  EXPECT_EQ(verified.status, 2);
  EXPECT_THAT(dir_.names(), ElementsAre("calm.toml", "shot.toml"));
}

struct Lost : Exercise {
  Circle ball{10.0, 10.0, 5.0};
  void start(Stage& stage) override { stage.add(ball); }
  void frame(Stage& stage, double) override { ball.setCenterX(stage.frame() < 3 ? 20.0 : std::nan("")); }
};

TEST(Warnings, OfAnExerciseInCppThatLosesAShape) {
  WarningLog strict(WarningLog::Mode::Strict);
  StageSource source(std::make_unique<Lost>(), {});
  source.watch(strict);
  EXPECT_NO_THROW(rehearse(source, 2));
  try {
    rehearse(source, 3);
    FAIL() << "nothing was said";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput);
    EXPECT_THAT(error.what(),
                StartsWith("offstage: error: frame 3 (0.05 s), body 0: its position is (nan, 10)"));
  }
}

TEST(Warnings, OfAnExerciseAreTheProgramsExitStatus) {
  const TempDir dir;
  const std::string out = dir / "x.mp4";
  const std::vector<const char*> arguments{"lost", "-o", out.c_str(), "--duration", "0.1", "--strict"};
  EXPECT_EQ(runExercise([] { return std::make_unique<Lost>(); }, static_cast<int>(arguments.size()),
                        arguments.data()),
            2);
  EXPECT_THAT(dir.names(), IsEmpty());
}

} // namespace
} // namespace offstage::test
