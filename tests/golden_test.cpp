#include "render/compare/golden_lock.h"
#include "render/compare/golden_states.h"
#include "src/scene/diagnostic.h"
#include "src/scene/scene.h"
#include "tests/support/golden_folder.h"
#include "tests/support/scene_text.h"

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

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

TEST(GoldenCommand, WhatWasRecordedIsTheSame) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  const ProcessResult recorded = folder.golden({"record", "."});
  EXPECT_EQ(recorded.status, 0) << recorded.err;
  EXPECT_THAT(recorded.out, AllOf(HasSubstr("recorded fall@0s\n"), HasSubstr("recorded fall@0.5s\n"),
                                  HasSubstr("2 recorded, 0 unchanged, 0 differ\n")));
  EXPECT_THAT(folder.dir().names(),
              ElementsAre("fall.states.csv", "fall.toml", "fall@0.5s.png", "fall@0s.png", "goldens.lock"));
  const ProcessResult verified = folder.golden({"verify", "."});
  EXPECT_EQ(verified.status, 0) << verified.out << verified.err;
  // Recording again changes nothing, to the byte.
  const std::string lock = readFile(folder.dir() / "goldens.lock");
  EXPECT_EQ(folder.golden({"record", "."}).status, 0);
  EXPECT_EQ(readFile(folder.dir() / "goldens.lock"), lock);
}

TEST(GoldenCommand, AnotherColourChangesPixelsButNotPhysics) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  folder.writeScene("fall", "blue", 40);
  const ProcessResult verified = folder.golden({"verify", "."});
  EXPECT_EQ(verified.status, 1);
  EXPECT_THAT(verified.out, AllOf(HasSubstr("fall@0.5s: pixels changed, physics did not\n"),
                                  Not(HasSubstr("physics changed\n"))));
  EXPECT_THAT(folder.dir().names("out/golden"),
              ElementsAre("drawn.lock", "fall.states.csv", "fall@0.5s.actual.png", "fall@0.5s.strip.png",
                          "fall@0s.actual.png", "fall@0s.strip.png", "report", "verified.txt"));
  EXPECT_TRUE(std::filesystem::exists(folder.dir() / "out/golden/report/index.html"));
}

TEST(GoldenCommand, AnotherGravityIsAnotherPhysicsInItsFirstFrameAndBody) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  folder.writeScene("fall", "red", 46);
  const ProcessResult verified = folder.golden({"verify", "."});
  EXPECT_EQ(verified.status, 1);
  EXPECT_THAT(verified.out,
              AllOf(HasSubstr("fall@0.5s: physics changed\n"), Not(HasSubstr("fall@0s")),
                    HasSubstr("  first frame that differs: 1\n"),
                    // 46/3600 px instead of 40/3600
                    HasSubstr("  frame 1 (0.0166667 s), body 0: y is 10.012777777777778, expected "
                              "10.011111111111111 (off by 0.00166667 px); body 0 is \"ball\"\n")));
}

TEST(GoldenCommand, AnotherBounceIsFoundInTheFrameOfTheBounce) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 400, "at = [1]");
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  std::string scene = readFile(folder.dir() / "fall.toml");
  scene.replace(scene.find("bottom = 0.5"), 12, "bottom = 0.6");
  folder.dir().write("fall.toml", scene);
  const ProcessResult verified = folder.golden({"verify", "."});
  EXPECT_EQ(verified.status, 1);
  // 32 px at 400 px/s² take 0.4 s: y = g·dt²·n(n + 1)/2 reaches them in step 24.
  EXPECT_THAT(verified.out,
              AllOf(HasSubstr("  first frame that differs: 24\n"), HasSubstr("body 0: vy is ")));
}

TEST(GoldenCommand, TellsSizeMissingAndObsolete) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  folder.writeScene("other", "red", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  std::string scene = readFile(folder.dir() / "fall.toml");
  scene.replace(scene.find("[64, 48]"), 8, "[65, 48]");
  folder.dir().write("fall.toml", scene);
  std::filesystem::remove(folder.dir() / "other@0s.png");
  folder.writeScene("other", "red", 40, "at = [0]");
  const ProcessResult verified = folder.golden({"verify", "."});
  EXPECT_EQ(verified.status, 1);
  EXPECT_THAT(verified.out,
              AllOf(HasSubstr("fall@0s: size changed\n"), HasSubstr("other@0s: golden missing\n"),
                    HasSubstr("other@0.5s: golden obsolete\n")));
}

TEST(GoldenCommand, RecordLeavesAGoldenThatDiffers) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  const std::string before = readFile(folder.dir() / "fall@0s.png");
  const std::string states = readFile(folder.dir() / "fall.states.csv");
  folder.writeScene("fall", "blue", 50, "at = [0, 0.25, 0.5]");
  const ProcessResult recorded = folder.golden({"record", "."});
  EXPECT_EQ(recorded.status, 1);
  EXPECT_THAT(recorded.out, HasSubstr("1 recorded, 0 unchanged, 2 differ\n"));
  EXPECT_EQ(readFile(folder.dir() / "fall@0s.png"), before);
  EXPECT_EQ(readFile(folder.dir() / "fall.states.csv"), states);
}

TEST(GoldenCommand, APictureWithoutALineIsComparedAndNeverReplacedByRecord) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40, "at = [0]");
  folder.writeScene("other", "red", 40, "at = [0]");
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  folder.writeScene("fall", "blue", 40, "at = [0]");
  std::filesystem::remove(folder.dir() / "goldens.lock");
  const std::string red = readFile(folder.dir() / "fall@0s.png");
  const ProcessResult verified = folder.golden({"verify", "."});
  EXPECT_EQ(verified.status, 1);
  EXPECT_THAT(verified.out,
              AllOf(HasSubstr("fall@0s: golden missing\n"), HasSubstr("132 px differ"),
                    HasSubstr("other@0s: golden missing\n"), HasSubstr("goldens.lock has no line for it")));
  const ProcessResult recorded = folder.golden({"record", "."});
  EXPECT_EQ(recorded.status, 1);
  EXPECT_THAT(recorded.out, HasSubstr("1 recorded, 0 unchanged, 1 differ\n"));
  EXPECT_EQ(readFile(folder.dir() / "fall@0s.png"), red);
}

TEST(GoldenCommand, AcceptTakesTheChosenOnesAsTheyWereSeen) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  EXPECT_EQ(folder.golden({"accept", "."}).status, 2); // nothing was looked at yet
  folder.writeScene("fall", "blue", 40, "at = [0.5, 1]");
  ASSERT_EQ(folder.golden({"verify", "."}).status, 1);

  const ProcessResult unknown = folder.golden({"accept", ".", "fall@0.6s"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err,
              HasSubstr("\"fall@0.6s\" is not among what the last verification left; did you mean "
                        "\"fall@0.5s\"?"));

  const ProcessResult one = folder.golden({"accept", ".", "fall@0.5s"});
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_THAT(one.out, HasSubstr("accepted fall@0.5s\n1 accepted"));
  EXPECT_EQ(readFile(folder.dir() / "fall@0.5s.png"),
            readFile(folder.dir() / "out/golden/fall@0.5s.actual.png"));

  ASSERT_EQ(folder.golden({"verify", "."}).status, 1); // the others
  EXPECT_EQ(folder.golden({"accept", "."}).status, 0);
  EXPECT_EQ(folder.golden({"verify", "."}).status, 0);
  EXPECT_THAT(folder.dir().names(), Not(Contains("fall@0s.png"))); // obsolete
}

TEST(GoldenCommand, AcceptRefusesWhatItIsNotSureOf) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  ASSERT_EQ(folder.golden({"verify", "."}).status, 1);
  // Another picture than the one that was drawn.
  std::filesystem::copy_file(folder.dir() / "out/golden/fall@0s.actual.png",
                             folder.dir() / "out/golden/fall@0.5s.actual.png",
                             std::filesystem::copy_options::overwrite_existing);
  const ProcessResult changed = folder.golden({"accept", ".", "fall@0.5s"});
  EXPECT_EQ(changed.status, 2);
  EXPECT_THAT(changed.err, HasSubstr("is not the picture that the last verification drew"));
  EXPECT_THAT(folder.dir().names(), Not(Contains("fall@0.5s.png")));
  // Another folder than the one that was verified.
  std::filesystem::create_directory(folder.dir() / "elsewhere");
  const ProcessResult elsewhere = folder.golden({"accept", "elsewhere"});
  EXPECT_EQ(elsewhere.status, 2);
  EXPECT_THAT(elsewhere.err, HasSubstr("verify first"));
}

TEST(GoldenCommand, ToleranceComesFromTheFolderOrTheScene) {
  const GoldenFolder folder;
  folder.writeScene("fall", "#ff0000", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  folder.writeScene("fall", "#fd0000", 40);
  EXPECT_EQ(folder.golden({"verify", "."}).status, 1);
  folder.dir().write("tolerance.toml", "max_channel = 2\n");
  EXPECT_EQ(folder.golden({"verify", "."}).status, 0);
  folder.writeScene("fall", "#fd0000", 40, "at = [0, 0.5]\nmax_channel = 1");
  EXPECT_EQ(folder.golden({"verify", "."}).status, 1);
  folder.writeScene("fall", "#fd0000", 40, "at = [0, 0.5]\nmax_channel = 2");
  std::filesystem::remove(folder.dir() / "tolerance.toml");
  EXPECT_EQ(folder.golden({"verify", "."}).status, 0);
}

TEST(GoldenCommand, BadInputIsRefused) {
  const GoldenFolder folder;
  EXPECT_EQ(folder.golden({}).status, 2);
  EXPECT_EQ(folder.golden({"verify"}).status, 2);
  EXPECT_EQ(folder.golden({"verify", "nowhere"}).status, 2);
  const ProcessResult none = folder.golden({"record", "."});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("no scene in . has a [golden]"));
  folder.writeScene("fall", "red", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  folder.dir().write("fall@0s.png", "no picture");
  EXPECT_EQ(folder.golden({"verify", "."}).status, 2);
  EXPECT_EQ(folder.golden({"verify", ".", "--out", "."}).status, 2);
}

TEST(GoldenCommand, ReportsAsJsonAndJunit) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  ASSERT_EQ(folder.golden({"record", "."}).status, 0);
  folder.writeScene("fall", "red", 46);
  const ProcessResult verified = folder.golden({"verify", ".", "--json", "--junit", "j.xml"});
  EXPECT_EQ(verified.status, 1);
  EXPECT_THAT(verified.out,
              AllOf(HasSubstr("\"first_differing_frame\": 1"), HasSubstr("\"physics changed\"")));
  EXPECT_THAT(readFile(folder.dir() / "j.xml"),
              AllOf(HasSubstr("offstage.golden"), HasSubstr("fall@0.5s"), HasSubstr("physics changed")));
}

TEST(GoldenCommand, ScenesMayStandInAnotherFolder) {
  const GoldenFolder folder;
  folder.writeScene("fall", "red", 40);
  std::filesystem::create_directory(folder.dir() / "goldens");
  EXPECT_EQ(folder.golden({"record", "goldens", "--scenes", "."}).status, 0);
  EXPECT_EQ(folder.golden({"verify", "goldens", "--scenes", "."}).status, 0);
  EXPECT_THAT(folder.dir().names("goldens"), Contains("goldens.lock"));
}

} // namespace
} // namespace offstage::test
