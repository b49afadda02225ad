#include "render/job/scene_source.h"
#include "render/raster/canvas.h"
#include "src/scene/panel.h"
#include "tests/support/canvas_pictures.h"
#include "tests/support/process.h"
#include "tests/support/scene_text.h"
#include "tests/support/temp_dir.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

const std::string kBall =
    "duration = 1.0\n[frame]\nsize = [200, 100]\n[world]\ngravity = [0, 300]\n[[body]]\n"
    "center = [50, 20]\nradius = 10\nvelocity = [40, 0]\nfill = \"#0000ff\"\n";

TEST(Panels, AreTheSceneWithChangesMergedKeyByKey) {
  const Scene scene =
      sceneOf(kBall + "[[panel]]\ntitle = \"a\"\nworld.integrator = \"rk4\"\n[[panel]]\nseed = 7\n"
                      "[[panel.body]]\ncenter = [1, 2]\nradius = 3\n");
  ASSERT_EQ(scene.panels.panels.size(), 2U);
  const Scene& first = *scene.panels.panels[0].scene;
  const Scene& second = *scene.panels.panels[1].scene;
  EXPECT_EQ(first.world.bodies.at(0).integrator, Integrator::Rk4);
  EXPECT_EQ(first.world.gravity, Vec2(0.0, 300.0)); // not given anew, so the scene's
  EXPECT_EQ(second.world.bodies.size(), 1U);
  EXPECT_EQ(second.world.bodies[0].radius, 3.0);
  EXPECT_EQ(second.world.seed, 7);
  EXPECT_EQ(scene.panels.columns, 2);
  EXPECT_EQ(scene.panels.pane, (std::array{200.0, 100.0}));
  EXPECT_EQ(scene.size, (std::array{2 * 200 + 3 * 16, 100 + 2 * 16 + 8}));
}

TEST(Panels, PanesKeepTheirAspectInAnyGrid) {
  Panels panels;
  panels.pane = {320.0, 240.0};
  panels.panels.resize(5);
  for (const int columns : {1, 2, 3, 5}) {
    panels.columns = columns;
    panels.caption = 20.0;
    for (std::size_t i = 0; i < 5; ++i) {
      const auto place = panels.place(i, 1920.0, 1080.0);
      EXPECT_NEAR(place[2] / place[3], 320.0 / 240.0, 1e-9) << columns;
      EXPECT_GE(place[0], panels.gap - 1e-9);
      EXPECT_GE(place[1], panels.gap + panels.caption - 1e-9);
      EXPECT_LE(place[0] + place[2], 1920.0 - panels.gap + 1e-9);
      EXPECT_LE(place[1] + place[3], 1080.0 - panels.gap + 1e-9);
    }
  }
}

/// As in a grid, in the middle, wherever a picture of another aspect leaves room.
TEST(Panels, OverlaidPanesKeepTheirAspectInAnyPicture) {
  struct Case {
    const char* size;
    double scale; ///< of the pane's 200×100 px
    Vec2 corner;  ///< px: the pane's upper left
  };
  for (const Case& each :
       {Case{"[200, 100]", 1.0, {0, 0}}, Case{"[400, 200]", 2.0, {0, 0}}, Case{"[600, 200]", 2.0, {100, 0}},
        Case{"[400, 500]", 2.0, {0, 150}}, Case{"[100, 100]", 0.5, {0, 25}}}) {
    const Scene scene = sceneOf(kBall + "[[panel]]\n[[panel]]\ntitle = \"two\"\n[panels]\n" +
                                "layout = \"overlaid\"\nsize = " + each.size + "\n");
    SceneSource source(scene, Viewport::scaled(scene.size[0], scene.size[1], 1.0));
    Picture picture;
    source.draw(picture);
    ASSERT_GE(picture.primitives.size(), 2U) << each.size;
    const auto right = static_cast<int>(each.corner.x() + 200.0 * each.scale);
    const auto bottom = static_cast<int>(each.corner.y() + 100.0 * each.scale);
    for (std::size_t i = 0; i < 2; ++i) {
      const Primitive& ball = picture.primitives[i];
      EXPECT_EQ(ball.center, Vec2(each.corner + each.scale * Vec2(50, 20))) << each.size;
      EXPECT_EQ(ball.outer, 10.0 * each.scale) << each.size;
      EXPECT_EQ(
          picture.clips.at(static_cast<std::size_t>(ball.clip)),
          (PixelRect{static_cast<int>(each.corner.x()), static_cast<int>(each.corner.y()), right, bottom}))
          << each.size;
    }
    for (const Primitive& letter : picture.primitives) { // the legend stands in the pane
      if (letter.kind != Primitive::Kind::Mask) continue;
      EXPECT_GE(letter.low.x(), each.corner.x()) << each.size;
      EXPECT_GE(letter.low.y(), each.corner.y()) << each.size;
      EXPECT_LE(letter.high.x(), right) << each.size;
      EXPECT_LE(letter.high.y(), bottom) << each.size;
    }
  }
}

/// Around panes that reach to the picture's edge it lies there, not beyond.
TEST(Panels, FramesAreWholeWithoutAnyGap) {
  for (const double scale : {1.0, 2.0}) {
    for (const int gap : {0, 10}) {
      const Scene scene = sceneOf("duration = 1\n[frame]\nsize = [200, 100]\n[[panel]]\n[[panel]]\n"
                                  "[panels]\ncolumns = 1\ngap = " +
                                  std::to_string(gap) + "\n");
      SceneSource source(scene, Viewport::scaled(scene.size[0], scene.size[1], scale));
      Picture picture;
      source.draw(picture);
      const Frame frame = drawOnce(picture);
      const auto line = static_cast<int>(scale);
      const int first = gap == 0 ? 0 : gap * line - line; // px: where the upper left pane's line begins
      const Rgba8 none{255, 255, 255, 255};
      for (int i = first; i < first + line; ++i) {
        const int right = frame.width - 1 - i;
        const int bottom = frame.height - 1 - i;
        EXPECT_NE(pixel(frame, i, 50 * line), none) << "left, gap " << gap << ", scale " << scale;
        EXPECT_NE(pixel(frame, right, 50 * line), none) << "right, gap " << gap << ", scale " << scale;
        EXPECT_NE(pixel(frame, 100 * line, i), none) << "top, gap " << gap << ", scale " << scale;
        EXPECT_NE(pixel(frame, 100 * line, bottom), none) << "bottom, gap " << gap << ", scale " << scale;
      }
      EXPECT_EQ(pixel(frame, first + line, 50 * line), none) << "gap " << gap << ", scale " << scale;
    }
  }
}

/// Each pane shows exactly what its world shows alone, and nothing of a neighbour.
TEST(Panels, ShowTheirWorldsInStep) {
  const std::string half = "[[panel]]\n[[panel]]\nclock.fps = 10\n[panels]\ngap = 10\n";
  const Scene scene = sceneOf(kBall + half);
  SceneSource source(scene, Viewport::scaled(scene.size[0], scene.size[1], 1.0));
  const Scene aloneScene = sceneOf(kBall);
  SceneSource alone(aloneScene, Viewport::scaled(200, 100, 1.0));
  const Scene slowScene = sceneOf(kBall + "[clock]\nfps = 10\n");
  SceneSource slow(slowScene, Viewport::scaled(200, 100, 1.0));
  for (int frame = 1; frame <= 27; ++frame) {
    source.step();
    alone.step();
    if (frame % 6 == 0) slow.step();
  }
  const auto drawn = [](const SceneSource& of) {
    Picture picture;
    of.draw(picture);
    return drawOnce(picture);
  };
  const Frame both = drawn(source);
  const Frame first = drawn(alone);
  const Frame second = drawn(slow);
  ASSERT_EQ(both.width, 430);
  ASSERT_EQ(both.height, 120);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) {
      ASSERT_EQ(pixel(both, x + 10, y + 10), pixel(first, x, y)) << "left, " << x << ", " << y;
      ASSERT_EQ(pixel(both, x + 220, y + 10), pixel(second, x, y)) << "right, " << x << ", " << y;
    }
  }
}

TEST(Panels, OverlaidOnesAreColouredAndDrawnInOnePlace) {
  const Scene scene = sceneOf(kBall + "[[panel]]\ncolor = \"red\"\n[[panel]]\ncolor = \"#00ff0080\"\n"
                                      "[panels]\nlayout = \"overlaid\"\n");
  EXPECT_EQ(scene.size, (std::array{200, 100}));
  SceneSource source(scene, Viewport::scaled(200, 100, 1.0));
  Picture picture;
  source.draw(picture);
  ASSERT_EQ(picture.primitives.size(), 2U);
  EXPECT_EQ(picture.primitives[0].color, (Rgba8{255, 0, 0, 255}));
  EXPECT_EQ(picture.primitives[1].color, (Rgba8{0, 255, 0, 128}));
  EXPECT_EQ(picture.primitives[0].center, picture.primitives[1].center);
}

/// It stands once over the whole picture, in its px; a text of the scene stands in every pane, in theirs.
TEST(Panels, TextsOverTheWholePictureBelongToNoPanel) {
  const std::string panels = "[[panel]]\n[[panel]]\n[panels]\ngap = 10\nsize = [860, 240]\n";
  const std::string whole = "[[panels.text]]\ntext = \"{t:.2f}\"\nat = [430, 120]\nsize = 20\n";
  const std::string own = "[[text]]\ntext = \"0\"\nat = [100, 50]\nsize = 10\n";
  const auto masksOf = [](const std::string& text) {
    const Scene scene = sceneOf(text);
    SceneSource source(scene, Viewport::scaled(scene.size[0], scene.size[1], 1.0));
    source.step();
    Picture picture;
    source.draw(picture);
    std::vector<Primitive> masks;
    for (const Primitive& primitive : picture.primitives)
      if (primitive.kind == Primitive::Kind::Mask) masks.push_back(primitive);
    return masks;
  };
  const std::vector<Primitive> once = masksOf(kBall + panels + whole);
  ASSERT_EQ(once.size(), 4U); // 0.02
  EXPECT_EQ(once.front().clip, -1);
  EXPECT_NEAR(0.5 * (once.front().low.x() + once.back().high.x()), 430.0, 2.0);
  EXPECT_NEAR(once.front().low.y(), 112.0, 3.0);
  const std::vector<Primitive> each = masksOf(kBall + own + panels);
  ASSERT_EQ(each.size(), 2U);
  EXPECT_NE(each[0].clip, each[1].clip);
  EXPECT_EQ(masksOf(kBall + own + panels + whole).size(), 6U);
  EXPECT_EQ(masksOf(kBall + panels + own).size(), 2U);

  const auto wrong = [&](const std::string& text) {
    return errorsOf(kBall + "name = \"ball\"\n" + panels + "[[panels.text]]\n" + text);
  };
  using ::testing::ElementsAre;
  using ::testing::HasSubstr;
  EXPECT_THAT(wrong("text = \"{count}\"\nplace = \"top\"\n"),
              ElementsAre(HasSubstr("18:8: error: a [[panels.text]] "
                                    "belongs to no panel")));
  EXPECT_THAT(wrong("text = \"{ball.x}\"\nplace = \"top\"\n"),
              ElementsAre(HasSubstr("its values are only t and frame")));
  EXPECT_THAT(wrong("text = \"{bull.x}\"\nplace = \"top\"\n"),
              ElementsAre(HasSubstr("no body and no group \"bull\"")));
  EXPECT_THAT(wrong("text = \"a\"\nat = \"ball\"\n"), ElementsAre(HasSubstr("it follows no body")));
  EXPECT_THAT(wrong("text = \"a\"\n"), ElementsAre(HasSubstr("needs 'at' or 'place'")));
}

TEST(Panels, PixelsDoNotDependOnJobs) {
  const TempDir dir;
  writeFile(dir / "scene.toml",
            kBall + "[[trail]]\n[[panel]]\ntitle = \"one\"\n[[panel]]\ntitle = \"two\"\nclock.fps = 20\n");
  const auto hashes = [&](const char* name, const char* jobs) {
    const ProcessResult result =
        offstage({"render", dir / "scene.toml", "-o", dir / (std::string(name) + "%03d.png"), "--hash",
                  dir / "hash.txt", "--jobs", jobs});
    EXPECT_EQ(result.status, 0) << result.err;
    return readFile(dir / "hash.txt");
  };
  EXPECT_EQ(hashes("a", "0"), hashes("b", "2"));
}

TEST(Panels, TellWhatIsWrongOnceAndWhere) {
  using ::testing::HasSubstr;
  EXPECT_THAT(
      errorsOf(
          kBall +
          "[[panel]]\nworld.integrator = \"rk5\"\n[[panel]]\nframe.size = [3, 4]\n[[panel]]\ncolor = 3\n"),
      ::testing::ElementsAre(HasSubstr("scene.toml:12:20: error: 'integrator' in [world] must be"),
                             HasSubstr("scene.toml:14:1: error: unknown key 'frame' in [[panel]]"),
                             HasSubstr("scene.toml:16:9: error: 'color' in [[panel]]")));
  const std::string camera = "camera]]\nat = 0\ncenter = [9, 9]\n";
  EXPECT_THAT(errorsOf(kBall + "[[panel]]\n[[" + camera),
              ::testing::ElementsAre(HasSubstr("[[camera]] cannot stand beside [[panel]]")));
  EXPECT_THAT(errorsOf(kBall + "[[panel]]\n[[panel." + camera),
              ::testing::ElementsAre(HasSubstr("unknown key 'camera' in [[panel]]")));
  EXPECT_THAT(errorsOf("[panels]\ngap = 3\n"), ::testing::ElementsAre(HasSubstr("there are none")));
  EXPECT_THAT(errorsOf("[[body]]\nradius = 2\n[[panel]]\n[[panel]]\n"),
              ::testing::ElementsAre(HasSubstr("[[body]] needs 'center'")));
  EXPECT_THAT(errorsOf(kBall + "[[panel]]\n[panels]\nsize = [30, 20]\n"),
              ::testing::ElementsAre(HasSubstr("no room")));
}

} // namespace
} // namespace offstage::test
