#include "render/stage/stage_source.h"

#include <memory>
#include <offstage/offstage.h>

#include <gtest/gtest.h>

namespace offstage {
namespace {

/// An exercise from two functions.
struct Scripted : Exercise {
  Settings chosen;
  std::function<void(Stage&)> atStart = [](Stage&) {};
  std::function<void(Stage&, double)> atFrame = [](Stage&, double) {};
  Settings settings() const override { return chosen; }
  void start(Stage& stage) override { atStart(stage); }
  void frame(Stage& stage, double dt) override { atFrame(stage, dt); }
};

Picture pictureOf(const Source& source) {
  Picture picture;
  source.draw(picture);
  return picture;
}

TEST(Stage, AHandleIsTheShapeItself) {
  Circle ball(10.0, 20.0, 5.0);
  Circle copy = ball;
  copy.setCenterX(30.0);
  EXPECT_EQ(ball.centerX(), 30.0);
  EXPECT_TRUE(ball == copy);
  EXPECT_FALSE(ball == Circle(30.0, 20.0, 5.0));
}

TEST(Stage, ShapesAreDrawnInOrderOfAddingAndMoveWithTheirHandles) {
  auto exercise = std::make_unique<Scripted>();
  Circle circle(10.0, 20.0, 5.0, Color::rgb(255, 0, 0));
  const Rectangle rectangle(1.0, 2.0, 30.0, 40.0, Color::rgb(0, 255, 0));
  exercise->atStart = [&](Stage& stage) {
    stage.add(rectangle);
    stage.add(circle);
    stage.add(rectangle); // there already: stays below
  };
  exercise->atFrame = [&](Stage&, double) { circle.setCenterX(100.0); };
  StageSource source(std::move(exercise), {});
  Picture picture = pictureOf(source);
  ASSERT_EQ(picture.primitives.size(), 2U);
  EXPECT_EQ(picture.primitives[0].kind, Primitive::Kind::Box);
  EXPECT_EQ(picture.primitives[0].color, (Rgba8{0, 255, 0, 255}));
  EXPECT_EQ(picture.primitives[1].kind, Primitive::Kind::Disc);
  EXPECT_EQ(picture.primitives[1].center.x(), 10.0);
  source.step();
  picture = pictureOf(source);
  EXPECT_EQ(picture.primitives[1].center.x(), 100.0);
}

TEST(Stage, LooksMayChangeAndRemovedShapesAreGone) {
  auto exercise = std::make_unique<Scripted>();
  Circle a(10.0, 20.0, 5.0);
  Circle b(50.0, 20.0, 5.0);
  exercise->atStart = [&](Stage& stage) {
    stage.add(a);
    stage.add(b);
  };
  exercise->atFrame = [&](Stage& stage, double) {
    if (stage.frame() == 1) b.setFill(Color::rgb(1, 2, 3));
    if (stage.frame() == 2) stage.remove(a);
    if (stage.frame() == 3) {
      b.setStroke(Color::rgb(9, 9, 9));
      b.setNoFill();
    }
    if (stage.frame() == 4) b.setVisible(false);
    if (stage.frame() == 5) stage.add(a);
  };
  StageSource source(std::move(exercise), {});
  source.step();
  EXPECT_EQ(pictureOf(source).primitives.at(1).color, (Rgba8{1, 2, 3, 255}));
  EXPECT_EQ(pictureOf(source).primitives.at(0).color, (Rgba8{0, 0, 0, 255}));
  source.step();
  ASSERT_EQ(pictureOf(source).primitives.size(), 1U);
  EXPECT_EQ(pictureOf(source).primitives[0].center.x(), 50.0);
  source.step();
  ASSERT_EQ(pictureOf(source).primitives.size(), 1U);
  EXPECT_EQ(pictureOf(source).primitives[0].kind, Primitive::Kind::Ring);
  source.step();
  EXPECT_TRUE(pictureOf(source).primitives.empty());
  source.step();
  ASSERT_EQ(pictureOf(source).primitives.size(), 1U);
  EXPECT_EQ(pictureOf(source).primitives[0].color, (Rgba8{0, 0, 0, 255}));
}

TEST(Stage, FixedClockGivesEveryFrameTheSameStep) {
  auto exercise = std::make_unique<Scripted>();
  std::vector<double> steps;
  std::vector<double> times;
  exercise->chosen.fps = 50.0;
  exercise->chosen.duration = 0.1;
  exercise->atFrame = [&](Stage& stage, double dt) {
    steps.push_back(dt);
    times.push_back(stage.time());
  };
  StageSource source(std::move(exercise), {});
  ASSERT_EQ(source.clock().steps(), 5);
  while (source.frame() < 5) source.step();
  EXPECT_EQ(steps, std::vector<double>(5, 1.0 / 50.0));
  EXPECT_EQ(times.back(), 5.0 / 50.0);
}

TEST(Stage, OptionsReplaceTheExercisesSettings) {
  auto exercise = std::make_unique<Scripted>();
  std::int32_t drawn = 0;
  exercise->chosen.seed = 1;
  exercise->atStart = [&](Stage& stage) { drawn = stage.random().nextInt(1000); };
  RenderOptions options;
  options.seed = 2022;
  options.fps = 30.0;
  options.duration = 2.0;
  options.size = {1280, 960};
  const StageSource source(std::move(exercise), options);
  EXPECT_EQ(drawn, Random(2022).nextInt(1000));
  EXPECT_EQ(source.clock().steps(), 60);
  EXPECT_EQ(pictureOf(source).width, 1280);
  EXPECT_EQ(pictureOf(source).height, 960);
}

TEST(Stage, StateHashFollowsWhatMoves) {
  auto exercise = std::make_unique<Scripted>();
  GameObject ball(Vec2(1.0, 2.0), 3.0, Vec2(4.0, 5.0));
  exercise->atStart = [&](Stage& stage) { stage.add(ball); };
  StageSource source(std::move(exercise), {});
  const std::uint64_t before = source.stateHash();
  EXPECT_EQ(source.stateHash(), before);
  ball.setVelocity(Vec2(4.0, 5.5));
  EXPECT_NE(source.stateHash(), before);
  ball.setVelocity(Vec2(4.0, 5.0));
  EXPECT_EQ(source.stateHash(), before);
}

TEST(Stage, RefusesSettingsThatCannotBe) {
  for (const auto& breakIt : std::vector<std::function<void(Settings&)>>{
           [](Settings& s) { s.fps = 0.0; }, [](Settings& s) { s.duration = -1.0; },
           [](Settings& s) { s.duration = 1e300; },
           [](Settings& s) {
             s.size = {0, 480};
           },
           [](Settings& s) { s.fps = std::nan(""); }}) {
    auto exercise = std::make_unique<Scripted>();
    breakIt(exercise->chosen);
    EXPECT_THROW(StageSource(std::move(exercise), {}), Error);
  }
}

TEST(GameObject, UpdateIsTheLecturesOrderVelocityFirst) {
  GameObject ball(Vec2(0.0, 100.0), 5.0, Vec2(10.0, 0.0), Vec2(0.0, 9.8));
  ball.update(0.5);
  EXPECT_EQ(ball.velocity().y(), 9.8 * 0.5);
  EXPECT_EQ(ball.position().x(), 5.0);
  EXPECT_EQ(ball.position().y(), 100.0 + (9.8 * 0.5) * 0.5);
}

TEST(Stage, TextsLieOverShapesAndLeaveTheStateHashAlone) {
  const auto sourceOf = [](bool told) {
    auto exercise = std::make_unique<Scripted>();
    Circle ball(100.0, 20.0, 5.0);
    Text label(100.0, 60.0, "one\ntwo", 20.0, Color::rgb(255, 0, 0));
    exercise->atStart = [=](Stage& stage) {
      if (told) stage.add(label);
      stage.add(ball);
    };
    exercise->atFrame = [=](Stage& stage, double) mutable {
      ball.setCenterX(100.0 + 10.0 * static_cast<double>(stage.frame()));
      label.setText("frame " + std::to_string(stage.frame()));
      if (stage.frame() == 2) stage.remove(label);
    };
    return std::make_unique<StageSource>(std::move(exercise), RenderOptions{});
  };
  const auto plain = sourceOf(false);
  const auto told = sourceOf(true);
  const Picture first = pictureOf(*told);
  ASSERT_EQ(first.primitives.size(), 1U + 6U);
  EXPECT_EQ(first.primitives[0].kind, Primitive::Kind::Disc);
  EXPECT_EQ(first.primitives[1].kind, Primitive::Kind::Mask);
  EXPECT_EQ(first.primitives[1].color, (Rgba8{255, 0, 0, 255}));
  for (const std::size_t letters : {6U, 0U}) {
    plain->step();
    told->step();
    EXPECT_EQ(pictureOf(*told).primitives.size(), 1U + letters) << "a blank has no pixels";
    EXPECT_EQ(plain->stateHash(), told->stateHash());
  }
}

TEST(Stage, ATextThatCannotBeSetIsRefusedBeforeItIsDrawn) {
  for (const auto& [text, size] : {std::pair("漢", 20.0), std::pair("x", 1e9), std::pair("x", -1.0)}) {
    auto exercise = std::make_unique<Scripted>();
    exercise->atStart = [text = text, size = size](Stage& stage) { stage.add(Text(1.0, 2.0, text, size)); };
    EXPECT_THROW(StageSource(std::move(exercise), {}), Error) << text << ' ' << size;
  }
}

} // namespace
} // namespace offstage
