#include "render/compare/golden_lock.h"
#include "render/compare/golden_states.h"
#include "src/scene/diagnostic.h"
#include "src/scene/scene.h"
#include "tests/support/scene_text.h"
#include "tests/support/temp_dir.h"

#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(GoldenTable, MomentsAreSortedNamedAndWithinTheScene) {
  EXPECT_THAT(sceneOf("duration = 4\n[golden]\nat = [4, 0, 2.5, 4]\n").golden->at, ElementsAre(0, 2.5, 4));
  EXPECT_THAT(sceneOf("duration = 0.5\n[golden]\nevery = 0.1\n").golden->at,
              ElementsAre(0, 0.1, 0.2, 0.3, 0.4, 0.5));
  EXPECT_EQ(goldenName("bounce", 2.5), "bounce@2.5s");
  EXPECT_EQ(goldenName("bounce", 3.0), "bounce@3s");
  EXPECT_THAT(
      errorsOf("duration = 4\n[golden]\nat = [1, 4.5]\n"),
      ElementsAre("scene.toml:3:10: error: value 2 of 'at' in [golden] is 4.5 s, but the scene ends at 4 s"));
  EXPECT_THAT(errorsOf("[golden]\n"), ElementsAre("scene.toml:1:1: error: [golden] needs 'at' or 'every'"));
  EXPECT_THAT(errorsOf("[golden]\nevery = 1e-9\n"),
              ElementsAre("scene.toml:2:9: error: 'every' in [golden] gives more than 10000 pictures"));
  EXPECT_THAT(errorsOf("[golden]\nat = 1\nmax_pixels = -1\n"), ::testing::SizeIs(2));
}

TEST(GoldenTable, MomentsBehindAGivenLengthAreLeftOut) {
  const TempDir dir;
  dir.write("short.dt", "1000000000\n");
  const auto at = [&](const std::string& golden, const auto& change) {
    SceneOverrides overrides;
    change(overrides);
    return parseScene(golden, dir / "scene.toml", overrides).golden->at;
  };
  const auto forASecond = [](SceneOverrides& overrides) { overrides.duration = 1.0; };
  const auto byLog = [&](SceneOverrides& overrides) { overrides.dtLog = dir / "short.dt"; };
  EXPECT_THAT(at("duration = 4\n[golden]\nat = [0, 1, 4]\n", forASecond), ElementsAre(0, 1));
  EXPECT_THAT(at("duration = 4\n[golden]\nat = [0, 1, 4]\n", byLog), ElementsAre(0, 1));
  EXPECT_THAT(at("duration = 4\n[golden]\nat = [3, 4]\n", forASecond), IsEmpty());
  EXPECT_THAT(at("duration = 4\n[golden]\nevery = 1\n", forASecond), ElementsAre(0, 1));
  // More pictures than may be, but only for this run.
  EXPECT_THAT(at("duration = 4\n[golden]\nevery = 1\n", [](auto& overrides) { overrides.duration = 2e4; }),
              IsEmpty());
  // At 60 frames a second the last step ends at 1 s, at 100 at 0.99 s.
  const std::string text = "duration = 0.99\n[golden]\nat = [1]\n";
  EXPECT_THAT(at(text, [](auto&) {}), ElementsAre(1));
  EXPECT_THAT(at(text, [](auto& overrides) { overrides.fps = 100.0; }), IsEmpty());
}

GoldenMachine machine(const std::string& processor) {
  GoldenMachine made =
      thisMachine("llvmpipe (LLVM 15.0.6, 256 bits)", "3.3 (Compatibility Profile) Mesa 22.3.6");
  made.processor = processor;
  return made;
}

TEST(GoldenLock, ReadsTheVersionsFromWhatGlSays) {
  EXPECT_EQ(machine("").llvm, "15.0.6");
  EXPECT_EQ(machine("").mesa, "22.3.6");
  EXPECT_EQ(thisMachine("", "4.6").mesa, "-");
  EXPECT_EQ(thisMachine("", "4.6").renderer, "-");
}

TEST(GoldenLock, IsSortedAndReadBack) {
  const TempDir dir;
  GoldenLock lock;
  lock.set("b@1s", {1, 2, machine("one")});
  lock.set("a@1s", {0xffffffffffffffffU, 4, machine("one")});
  lock.save(dir / "goldens.lock");
  EXPECT_THAT(readFile(dir / "goldens.lock"),
              AllOf(HasSubstr("# golden\tstate\tpixels\t"),
                    HasSubstr("\na@1s\tffffffffffffffff\t0000000000000004\tllvmpipe (LLVM 15.0.6, 256 "
                              "bits)\t22.3.6\t15.0.6\tone\t"),
                    HasSubstr("\nb@1s\t0000000000000001\t0000000000000002\t")));
  const GoldenLock back = GoldenLock::load(dir / "goldens.lock");
  ASSERT_NE(back.find("b@1s"), nullptr);
  EXPECT_EQ(back.find("b@1s")->pixels, 2U);
  EXPECT_EQ(back.find("c@1s"), nullptr);
  EXPECT_THAT(GoldenLock::load(dir / "none.lock").entries(), IsEmpty());
}

TEST(GoldenLock, ALineStaysWhenOnlyTheMachineIsAnotherOne) {
  GoldenLock lock;
  lock.set("a@1s", {1, 2, machine("one")});
  lock.set("a@1s", {1, 2, machine("two")});
  EXPECT_EQ(lock.find("a@1s")->machine.processor, "one");
  lock.set("a@1s", {1, 3, machine("two")});
  EXPECT_EQ(lock.find("a@1s")->machine.processor, "two");
}

TEST(GoldenLock, TellsWhichLineIsWrong) {
  const TempDir dir;
  const auto errorOf = [&dir](const std::string& text) -> std::string {
    const auto file = dir.write("goldens.lock", text);
    try {
      static_cast<void>(GoldenLock::load(file));
    } catch (const SceneError& error) {
      return std::string(error.what()).substr(dir.path().string().size() + 1);
    }
    return "no error";
  };
  const std::string rest = "\tgl\tmesa\tllvm\tcpu\t0.1\n";
  EXPECT_EQ(errorOf("# x\n\na\t0000000000000001\t000000000000000g" + rest),
            "goldens.lock:3:20: error: a hash has 16 hexadecimal digits, but here is \"000000000000000g\"");
  EXPECT_EQ(errorOf("a\tb\n"),
            "goldens.lock:1:1: error: a golden's line has 8 cells separated by tabs, but this one has 2");
  EXPECT_EQ(errorOf("../a\t0000000000000001\t0000000000000001" + rest),
            "goldens.lock:1:1: error: \"../a\" is no golden's name");
  const std::string line = "a\t0000000000000001\t0000000000000001" + rest;
  EXPECT_EQ(errorOf(line + line), "goldens.lock:2:1: error: \"a\" has a line already");
}

std::vector<Body> crowd(std::size_t count, double x) {
  std::vector<Body> bodies(count);
  for (std::size_t i = 0; i < count; ++i) {
    bodies[i].id = static_cast<std::uint32_t>(i);
    bodies[i].position = {x, static_cast<double>(i)};
    bodies[i].radius = 1.0;
  }
  return bodies;
}

/// A run of 100 frames with so many bodies; the hash of frame k is `salt` + k from frame `from` on.
std::string recordedRun(std::size_t bodies, std::vector<std::int64_t> goldens) {
  GoldenRecorder recorder({"bodies"}, std::move(goldens));
  for (int frame = 0; frame < 100; ++frame)
    recorder.add(frame, frame * 0.1, static_cast<std::uint64_t>(frame), crowd(bodies, frame));
  return recorder.text();
}

TEST(GoldenStates, AFewBodiesAreKeptWholeAndACrowdBySamples) {
  const GoldenStates few = parseGoldenStates(recordedRun(10, {7}), "x");
  EXPECT_EQ(few.stride, 1);
  EXPECT_EQ(few.hashes.size(), 100U);
  EXPECT_EQ(few.trace.rows.size(), 1000U);
  const GoldenStates crowded = parseGoldenStates(recordedRun(50, {7, 99}), "x");
  EXPECT_EQ(crowded.stride, 8); // 13 frames of 50 rows; a stride of 4 has 25, more than 1000 rows
  EXPECT_EQ(crowded.trace.rows.size(), (13U + 2U) * 50U);
  EXPECT_TRUE(crowded.keeps(7) && crowded.keeps(8) && !crowded.keeps(9));
}

TEST(GoldenStates, TellsTheFirstFrameAndBodyThatChanged) {
  const GoldenStates recorded = parseGoldenStates(recordedRun(10, {}), "x");
  StatesWatch watch(recorded);
  for (int frame = 0; frame < 100; ++frame) {
    std::vector<Body> bodies = crowd(10, frame);
    if (frame >= 30) bodies[4].position.y() += 0.5;
    watch.add(frame, frame * 0.1, static_cast<std::uint64_t>(frame < 30 ? frame : frame + 1000), bodies);
    EXPECT_EQ(watch.difference().firstFrame.has_value(), frame >= 30);
  }
  const StatesDifference difference = watch.difference();
  EXPECT_EQ(difference.firstFrame, 30);
  ASSERT_TRUE(difference.comparison.first);
  EXPECT_EQ(difference.comparison.first->frame, 30);
  EXPECT_EQ(difference.comparison.first->body, 4);
  EXPECT_EQ(difference.comparison.first->error, 0.5);
}

TEST(GoldenStates, TellsWhatIsWrongWithAFile) {
  const auto errorOf = [](const std::string& text) -> std::string {
    try {
      static_cast<void>(parseGoldenStates(text, "x"));
    } catch (const SceneError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(errorOf(""), "x:1:1: error: this is no file of golden states");
  EXPECT_EQ(errorOf("# offstage golden states 1: frames 0 to 1, stride 0\n"),
            "x:1:52: error: the numbers of this line cannot be");
  EXPECT_EQ(errorOf("# offstage golden states 1: frames 0 to 1, stride 1\n# hashes of frame 0: 000001\n"),
            "x:3:1: error: 1 hashes stand here for 2 frames");
  const std::string good = recordedRun(1, {});
  EXPECT_EQ(errorOf(good), "no error");
  for (std::size_t length = 0; length < good.find("frame,id"); length += 7)
    EXPECT_NE(errorOf(good.substr(0, length)), "no error") << length;
}

} // namespace
} // namespace offstage::test
