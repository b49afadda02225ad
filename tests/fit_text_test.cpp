#include "render/draw/fit_text.h"
#include "render/job/scene_source.h"
#include "tests/support/scene_text.h"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

struct FitText : ::testing::Test {
  TextPainter painter{Viewport::scaled(640, 480, 1.0)};
  TextLook look{};
  [[nodiscard]] double width(const FittedText& text) const {
    return painter.measure(text.text, text.look).x();
  }
};

TEST_F(FitText, IsAsItIsWhereItFits) {
  const double whole = painter.measure("Kinetic energy", look).x();
  const FittedText text = fitText(painter, "Kinetic energy", look, whole, 10.0);
  EXPECT_EQ(text.text, "Kinetic energy");
  EXPECT_EQ(text.look.size, look.size);
}

TEST_F(FitText, IsSmallerByAsMuchAsItTakes) {
  const double whole = painter.measure("Kinetic energy", look).x();
  const FittedText text = fitText(painter, "Kinetic energy", look, 0.8 * whole, 10.0);
  EXPECT_EQ(text.text, "Kinetic energy");
  EXPECT_NEAR(text.look.size, 0.8 * look.size, 1e-9);
  EXPECT_NEAR(width(text), 0.8 * whole, 1e-6);
  look.upwards = true;
  EXPECT_NEAR(fitText(painter, "Kinetic energy", look, 0.8 * whole, 10.0).look.size, 0.8 * look.size, 1e-9);
}

TEST_F(FitText, EndsInAnEllipsisWhereTheLeastSizeIsTooLarge) {
  for (const double room : {20.0, 60.0, 100.0, 150.0}) {
    const FittedText text = fitText(painter, "Kinetic energy of the ball", look, room, 20.0);
    EXPECT_EQ(text.look.size, 20.0);
    EXPECT_LE(width(text), room) << text.text;
    EXPECT_THAT(text.text, ::testing::EndsWith("…"));
    EXPECT_THAT(text.text, ::testing::Not(::testing::HasSubstr(" …")));
    EXPECT_GT(width(text) + 20.0, room) << text.text << ": the next letter would not fit";
  }
  EXPECT_EQ(fitText(painter, "Kinetic energy", look, 5.0, 20.0).text, "") << "no room for the ellipsis";
}

TEST_F(FitText, IsCutBetweenCharactersAndLineByLine) {
  const FittedText greek = fitText(painter, "ωωωωωωωωωω", look, 90.0, 20.0);
  EXPECT_EQ(greek.text.size() % 2, 1U) << greek.text; // whole letters of two bytes, and one of three
  const FittedText lines = fitText(painter, "short\nthis one is much too long\nend", look, 100.0, 20.0);
  EXPECT_THAT(lines.text, ::testing::StartsWith("short\nthis"));
  EXPECT_THAT(lines.text, ::testing::EndsWith("…\nend"));
}

TEST_F(FitText, LeavesRoomForWhatStandsBesideIt) {
  const FittedText text = fitText(painter, "Kinetic energy", look, 100.0, 5.0, 0.9);
  EXPECT_NEAR(width(text) + 0.9 * text.look.size, 100.0, 1e-6);
}

/// Around all letters and discs of a scene's first frame; px.
struct Extent {
  Vec2 low = Vec2::Constant(1e9);
  Vec2 high = Vec2::Constant(-1e9);
};
Extent extentOf(const std::string& text) {
  const Scene scene = sceneOf(text);
  const SceneSource source(scene, Viewport::scaled(scene.size[0], scene.size[1], 1.0));
  Picture picture;
  source.draw(picture);
  Extent extent;
  for (const Primitive& p : picture.primitives) {
    const bool disc = p.kind == Primitive::Kind::Disc;
    if (!disc && p.kind != Primitive::Kind::Mask) continue;
    const Vec2 reach = Vec2::Constant(p.outer);
    extent.low = extent.low.cwiseMin(disc ? Vec2(p.center - reach) : p.low);
    extent.high = extent.high.cwiseMax(disc ? Vec2(p.center + reach) : p.high);
  }
  return extent;
}

const std::string kLong = "a text that is longer than anything in which it could stand, however small it is";

TEST(PlotLabels, StayInTheArea) {
  for (const std::string& text : {kLong, kLong.substr(0, 36)}) {
    for (const char* key : {"title", "x_label", "y_label"}) {
      const Extent extent =
          extentOf("duration = 1\n[[plot]]\narea = [200, 100, 220, 200]\ny = [\"energy\", \"t\"]\n" +
                   (key + (" = \"" + text + "\"\n")));
      EXPECT_GE(extent.low.x(), 200.0) << key << ": " << text;
      EXPECT_GE(extent.low.y(), 100.0) << key << ": " << text;
      EXPECT_LE(extent.high.x(), 420.0) << key << ": " << text;
      EXPECT_LE(extent.high.y(), 300.0) << key << ": " << text;
    }
  }
}

TEST(PanelTitles, AreNoLongerThanTheirPane) {
  for (const char* color : {"", "color = \"red\"\n"}) {
    for (const char* layout : {"columns = 2", "layout = \"overlaid\""}) {
      const Extent extent =
          extentOf("duration = 1\n[frame]\nsize = [320, 240]\n[panels]\n" + std::string(layout) +
                   "\n[[panel]]\ntitle = \"" + kLong + "\"\n" + color + "[[panel]]\n");
      const double right = std::string(layout) == "columns = 2" ? 336.0 : 320.0;
      EXPECT_GE(extent.low.x(), 4.0) << layout << color;
      EXPECT_LE(extent.high.x(), right) << layout << color;
      EXPECT_GE(extent.high.x() - extent.low.x(), 250.0) << layout << color;
    }
  }
}

} // namespace
} // namespace offstage::test
