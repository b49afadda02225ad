#include "render/stage/stage_source.h"
#include "src/scene/input_log.h"
#include "src/sim/world.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"

#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kGame = "# a short game\n"
                              "0.1 mouse 100 50\n"
                              "0.25 key down SPACE\r\n"
                              "0.30 key down SPACE\n" // repeats while it is held
                              "\n"
                              "0.5 key up SPACE\n"
                              "0.5 mouse 200 60\n"
                              "0.55 button down left\n"
                              "0.75 key down SPACE\n"
                              "0.80 button up left\n";

TEST(InputLog, HoldsEventsWithThePointersPlace) {
  const InputLog log = InputLog::parse(kGame, "game.log");
  ASSERT_EQ(log.events().size(), 8U);
  EXPECT_EQ(log.events()[1].action, InputAction::KeyDown);
  EXPECT_EQ(log.events()[1].name, "SPACE");
  EXPECT_EQ(log.events()[1].mouse, Vec2(100, 50));
  EXPECT_THAT(log.presses(InputAction::KeyDown, "SPACE"), ElementsAre(0.25, 0.75));
  EXPECT_THAT(log.presses(InputAction::ButtonDown, "left"), ElementsAre(0.55));
  EXPECT_THAT(log.presses(InputAction::KeyDown, "left"), IsEmpty());
  EXPECT_EQ(log.mouseAt(0.05), Vec2(0, 0));
  EXPECT_EQ(log.mouseAt(0.1), Vec2(100, 50));
  EXPECT_EQ(log.mouseAt(9.0), Vec2(200, 60));
}

TEST(InputLog, NamesTheLineThatIsNoEvent) {
  const auto error = [](const std::string& line) {
    return errorOf([&] { InputLog::parse("0.5 key up A\n" + line + "\n", "game.log"); });
  };
  EXPECT_THAT(error("x key down A"), HasSubstr("game.log:2:1: error: \"x\" is not a time in s"));
  EXPECT_THAT(error("nan key down A"), HasSubstr("2:1: error: \"nan\" is not a time in s"));
  EXPECT_THAT(error("-1 key down A"), HasSubstr("2:1: error: a time must be at least 0, but it is -1"));
  EXPECT_THAT(error("0.4 key down A"),
              HasSubstr("2:1: error: times must not go back, but 0.4 comes after 0.5"));
  EXPECT_THAT(error("0.5 kye down A"), HasSubstr("2:1: error: an event is 'TIME key down NAME'"));
  EXPECT_THAT(error("0.5 key down"), HasSubstr("2:1: error: an event is"));
  EXPECT_THAT(error("0.5"), HasSubstr("2:1: error: an event is"));
  EXPECT_THAT(error("0.5 key down A B"), HasSubstr("2:16: error: \"B\" is too much here"));
  EXPECT_THAT(error("0.5 button down middel"), HasSubstr("2:17: error: a button is left, middle or right"));
  EXPECT_THAT(error("0.5 mouse 3 inf"), HasSubstr("2:13: error: \"inf\" is not a position in px"));
  EXPECT_EQ(error(""), "no error");
}

/// The launches of a scene whose user plays kGame: frame, position, velocity.
std::vector<std::string> launchesOf(const std::string& launch, const std::string& clock = "fps = 10") {
  const TempDir folder;
  folder.write("game.log", kGame);
  const Scene scene =
      parseScene("duration = 1\n[clock]\n" + clock +
                     "\n[input]\nlog = 'game.log'\n[[body]]\nname = 'ball'\n"
                     "center = [0, 0]\nradius = 1\nfixed = true\n[[launch]]\nspeed = 10\nradius = 1\n" +
                     launch,
                 folder.path() / "s.toml");
  World world(scene.world);
  std::vector<std::string> launches;
  while (world.frame() < scene.clock.steps()) {
    world.step(scene.clock.tick(world.frame() + 1));
    for (const Event& event : world.events())
      launches.push_back(fmt::format("{}: {} {} {}", event.frame, name(event.kind), event.p, event.q));
  }
  return launches;
}

TEST(RecordedInput, LaunchesWhenTheKeyGoesDownTowardThePointer) {
  // The steps to the first frames not before 0.25 s and 0.75 s; (100, 50) and (200, 60) from (100, 0).
  EXPECT_THAT(launchesOf("on = 'key SPACE'\nfrom = [100, 0]\ntoward = 'mouse'\n"),
              ElementsAre("3: fire 0 10", HasSubstr("8: fire 8.57")));
  EXPECT_THAT(launchesOf("on = 'button left'\nfrom = 'mouse'\ntoward = [200, 0]\n"),
              ElementsAre("6: fire 0 -10"));
  EXPECT_THAT(launchesOf("at = 0.2\nfrom = 'ball'\ntoward = 'mouse'\n"),
              ElementsAre(HasSubstr("2: fire 8.94")));
  EXPECT_THAT(launchesOf("frame = 4\nfrom = 'mouse'\ntoward = [100, 100]\n"), ElementsAre("4: fire 0 10"));
  EXPECT_THAT(launchesOf("on = 'key ENTER'\nfrom = [0, 0]\ntoward = [1, 1]\n"), IsEmpty());
}

TEST(RecordedInput, BelongsToTheFramesThatTheUserSawWhateverTheirSteps) {
  const std::string press = "on = 'key SPACE'\nfrom = [100, 0]\ntoward = 'mouse'\n";
  const auto inFrames = ElementsAre("3: fire 0 10", HasSubstr("8: fire 8.57"));
  for (const char* steps : {"'fixed'\ndt = 0.1", "'fixed'\ndt = 0.02", "'fixed'\ndt = 0.3",
                            "'clamped'\ndt = 0.02", "'accumulator'\ndt = 0.02"}) {
    EXPECT_THAT(launchesOf(press, fmt::format("fps = 10\nstep = {}", steps)), inFrames) << steps;
  }
  // Steps at 0.3, 0.6 and 0.9 s: the next one after 0.25 s and after 0.75 s.
  EXPECT_THAT(launchesOf(press, "fps = 10\nstep = 'accumulator'\ndt = 0.3"),
              ElementsAre("3: fire 0 10", HasSubstr("9: fire 8.57")));
}

TEST(RecordedInput, IsReportedWhereItIsMissingOrWrong) {
  const auto errors = [](const std::string& text) {
    return errorOf([&] { static_cast<void>(parseScene(text, "s.toml")); });
  };
  const std::string launch = "[[launch]]\nspeed = 1\nradius = 1\nfrom = [0, 0]\n";
  EXPECT_THAT(errors(launch + "toward = 'mouse'\nat = 1\n"),
              HasSubstr("s.toml:5:10: error: 'toward' in [[launch]] is the pointer of recorded input, but "
                        "the scene has no [input]"));
  EXPECT_THAT(errors(launch + "toward = [1, 1]\non = 'key A'\n"),
              HasSubstr("s.toml:6:6: error: 'on' in [[launch]] waits for recorded input"));
  EXPECT_THAT(errors(launch + "toward = [1, 1]\non = 'SPACE'\n"), HasSubstr("must be \"key NAME\""));
  EXPECT_THAT(errors(launch + "toward = [1, 1]\non = 'key A'\nat = 1\n"),
              HasSubstr("'on' in [[launch]] cannot stand beside 'at'"));
  EXPECT_THAT(errors(launch + "toward = [1, 1]\n"), HasSubstr("[[launch]] needs 'at', 'frame' or 'on'"));
  EXPECT_THAT(errors("[input]\nlog = 'none.log'\n"), HasSubstr("does not exist beside the scene"));
}

TEST(RecordedInput, AMissingLogIsTheOnlyError) {
  for (const char* input : {"log = 'none.log'\n", "log = 3\n", ""}) {
    const std::string error = errorOf([&] {
      static_cast<void>(parseScene(fmt::format("[input]\n{}[[launch]]\nspeed = 1\nradius = 1\nfrom = "
                                               "[0, 0]\ntoward = 'mouse'\non = 'key A'\n",
                                               input),
                                   "s.toml"));
    });
    EXPECT_THAT(error, HasSubstr("[input]")) << input;
    EXPECT_THAT(error, Not(HasSubstr("[[launch]]"))) << input;
  }
}

/// Notes what its user does in every frame.
struct Player : Exercise {
  std::vector<std::string>& notes;
  explicit Player(std::vector<std::string>& to) : notes(to) {}
  [[nodiscard]] Settings settings() const override {
    Settings settings;
    settings.fps = 10.0;
    settings.duration = 1.0;
    return settings;
  }
  void note(const Stage& stage) {
    const Input& input = stage.input();
    notes.push_back(fmt::format("{}{}{}{} {} {} {}", input.isDown("SPACE") ? "d" : "-",
                                input.wentDown("SPACE") ? "p" : "-", input.isButtonDown("left") ? "d" : "-",
                                input.buttonWentDown("left") ? "p" : "-", input.mouse().x(),
                                input.mouse().y(), input.events().size()));
  }
  void start(Stage& stage) override { note(stage); }
  void frame(Stage& stage, double) override { note(stage); }
};

TEST(RecordedInput, ExercisesSeeItFrameByFrame) {
  const TempDir folder;
  RenderOptions options;
  options.input = folder.write("game.log", kGame);
  std::vector<std::string> notes;
  StageSource source(std::make_unique<Player>(notes), options);
  while (source.frame() < source.clock().steps()) source.step();
  EXPECT_THAT(notes, ElementsAre("---- 0 0 0", "---- 100 50 1", "---- 100 50 0", "dp-- 100 50 2",
                                 "d--- 100 50 0", "---- 200 60 2", "--dp 200 60 1", "--d- 200 60 0",
                                 "dp-- 200 60 2", "d--- 200 60 0", "d--- 200 60 0"));
}

TEST(RecordedInput, WithoutARecordingNothingHappens) {
  std::vector<std::string> notes;
  StageSource source(std::make_unique<Player>(notes), RenderOptions{});
  source.step();
  EXPECT_THAT(notes, ElementsAre("---- 0 0 0", "---- 0 0 0"));
}

} // namespace
} // namespace offstage::test
