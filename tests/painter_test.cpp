#include "render/draw/painter.h"
#include "src/sim/error.h"

#include <limits>
#include <ostream>

#include <gtest/gtest.h>

namespace offstage {
namespace {

const Color kRed = Color::rgb(200, 0, 0);
const Color kBlue = Color::rgb(0, 0, 200);
const std::filesystem::path kAssets = OFFSTAGE_SOURCE_DIR "/tests/reference/stills/assets";

Look filled(const Paint& fill) {
  Look look;
  look.fill = fill;
  return look;
}

Look stroked(const Color& color, double width, StrokeAlign align) {
  Look look;
  look.fill.reset();
  look.stroke = Stroke{color, width, align};
  return look;
}

ImagePattern pattern(std::array<double, 4> anchor, bool proportional) {
  ImagePattern result;
  result.file = kAssets / "pattern.png"; // 64×48
  result.anchor = anchor;
  result.proportional = proportional;
  return result;
}

/// What one circle or rectangle becomes.
Picture paintCircle(const Look& look, const Vec2& center, double radius,
                    const Viewport& viewport = Viewport::scaled(640, 480, 1.0)) {
  Painter painter(viewport, Color::rgb(255, 255, 255));
  Picture picture;
  painter.begin(picture);
  painter.circle(picture, center, radius, painter.addLook(look));
  return picture;
}

Picture paintRectangle(const Look& look, const Vec2& position, const Vec2& size,
                       const Viewport& viewport = Viewport::scaled(640, 480, 1.0)) {
  Painter painter(viewport, Color::rgb(255, 255, 255));
  Picture picture;
  painter.begin(picture);
  painter.rectangle(picture, position, size, painter.addLook(look));
  return picture;
}

TEST(Painter, BeginSetsSizeBackgroundAndClip) {
  const Painter painter(Viewport::fitted(100, 100, 300, 200), Color::rgb(1, 2, 3, 0.5));
  Picture picture;
  picture.primitives.resize(3);
  painter.begin(picture);
  EXPECT_EQ(picture.width, 300);
  EXPECT_EQ(picture.height, 200);
  EXPECT_EQ(picture.background, (Rgba8{1, 2, 3, 127}));
  EXPECT_EQ(picture.clip, (PixelRect{50, 0, 250, 200}));
  EXPECT_TRUE(picture.primitives.empty());
}

TEST(Painter, FillComesBeforeStroke) {
  Look look = filled(kRed);
  look.stroke = Stroke{kBlue, 4.0, StrokeAlign::Centered};
  const Picture picture = paintCircle(look, {100, 50}, 20);
  ASSERT_EQ(picture.primitives.size(), 2U);
  EXPECT_EQ(picture.primitives[0].kind, Primitive::Kind::Disc);
  EXPECT_EQ(picture.primitives[0].color, (Rgba8{200, 0, 0, 255}));
  EXPECT_EQ(picture.primitives[0].center, Vec2(100, 50));
  EXPECT_EQ(picture.primitives[0].outer, 20.0);
  EXPECT_EQ(picture.primitives[1].kind, Primitive::Kind::Ring);
  EXPECT_EQ(picture.primitives[1].color, (Rgba8{0, 0, 200, 255}));
}

struct StrokeCase {
  StrokeAlign align;
  double width;
  double inner, outer; ///< of a circle of radius 3; equal: nothing is drawn
};

TEST(Painter, CircleStrokesReachWhereJavaFxDrawsThem) {
  const StrokeAlign centered = StrokeAlign::Centered;
  const StrokeAlign inside = StrokeAlign::Inside;
  const StrokeAlign outside = StrokeAlign::Outside;
  for (const StrokeCase& expected :
       {StrokeCase{centered, 2, 2, 4}, StrokeCase{centered, 6, 0, 6}, StrokeCase{centered, 10, 2, 8},
        StrokeCase{inside, 2, 1, 3}, StrokeCase{inside, 3, 0, 3}, StrokeCase{inside, 5, 2, 3},
        StrokeCase{inside, 10, 3, 3}, StrokeCase{outside, 2, 3, 5}, StrokeCase{outside, 10, 7, 13},
        StrokeCase{outside, 0, 3, 3}}) {
    const Picture picture = paintCircle(stroked(kRed, expected.width, expected.align), {50, 50}, 3);
    const bool drawn = expected.inner < expected.outer;
    ASSERT_EQ(picture.primitives.size(), drawn ? 1U : 0U) << "width " << expected.width;
    if (!drawn) continue;
    EXPECT_EQ(picture.primitives[0].inner, expected.inner) << "width " << expected.width;
    EXPECT_EQ(picture.primitives[0].outer, expected.outer) << "width " << expected.width;
  }
}

TEST(Painter, RectangleStrokesHaveMitreCorners) {
  const auto check = [](StrokeAlign align, double width, const Vec2& low, const Vec2& high,
                        const Vec2& innerLow, const Vec2& innerHigh) {
    const Picture picture = paintRectangle(stroked(kRed, width, align), {10, 20}, {30, 40});
    ASSERT_EQ(picture.primitives.size(), 1U);
    const Primitive& primitive = picture.primitives[0];
    EXPECT_EQ(primitive.kind, Primitive::Kind::BoxRing);
    EXPECT_EQ(primitive.low, low);
    EXPECT_EQ(primitive.high, high);
    EXPECT_EQ(primitive.innerLow, innerLow);
    EXPECT_EQ(primitive.innerHigh, innerHigh);
  };
  check(StrokeAlign::Centered, 4, {8, 18}, {42, 62}, {12, 22}, {38, 58});
  check(StrokeAlign::Inside, 4, {10, 20}, {40, 60}, {14, 24}, {36, 56});
  check(StrokeAlign::Outside, 4, {6, 16}, {44, 64}, {10, 20}, {40, 60});
}

TEST(Painter, OpacityMultipliesAlphaAndFloors) {
  Look look = filled(Color::rgb(9, 9, 9, 0.5));
  look.opacity = 0.5;
  EXPECT_EQ(paintCircle(look, {9, 9}, 5).primitives.at(0).color.a, 63); // 63.75
  look.opacity = 0.0;
  EXPECT_TRUE(paintCircle(look, {9, 9}, 5).primitives.empty());
  Look image = filled(pattern({0, 0, 1, 1}, true));
  image.opacity = 0.25;
  EXPECT_EQ(paintCircle(image, {9, 9}, 5).primitives.at(0).color.a, 63);
}

TEST(Painter, BadGeometryPaintsNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  Look look = filled(kRed);
  look.stroke = Stroke{kBlue, 2.0, StrokeAlign::Centered};
  for (const double bad : {nan, infinite, -infinite, -1.0, 0.0}) {
    EXPECT_TRUE(paintCircle(look, {50, 50}, bad).primitives.empty()) << "radius " << bad;
    EXPECT_TRUE(paintRectangle(look, {50, 50}, {bad, 5}).primitives.empty()) << "width " << bad;
    EXPECT_TRUE(paintRectangle(look, {50, 50}, {5, bad}).primitives.empty()) << "height " << bad;
  }
  for (const double bad : {nan, infinite, -infinite}) {
    EXPECT_TRUE(paintCircle(look, {bad, 50}, 5).primitives.empty()) << "x " << bad;
    EXPECT_TRUE(paintCircle(look, {50, bad}, 5).primitives.empty()) << "y " << bad;
    EXPECT_TRUE(paintRectangle(look, {bad, 50}, {5, 5}).primitives.empty()) << "x " << bad;
    EXPECT_TRUE(paintCircle(stroked(kRed, bad, StrokeAlign::Outside), {50, 50}, 5).primitives.empty())
        << "stroke width " << bad;
  }
}

TEST(Painter, WhatCannotBeSeenIsLeftOut) {
  const Look look = filled(kRed);
  EXPECT_TRUE(paintCircle(look, {-20, 50}, 20).primitives.empty());
  EXPECT_EQ(paintCircle(look, {-20, 50}, 20.01).primitives.size(), 1U);
  EXPECT_TRUE(paintRectangle(look, {640, 10}, {5, 5}).primitives.empty());
  EXPECT_EQ(paintRectangle(look, {639.9, 10}, {5, 5}).primitives.size(), 1U);
  EXPECT_EQ(paintCircle(stroked(kRed, 5, StrokeAlign::Outside), {-20, 50}, 20).primitives.size(), 1U);
}

TEST(Painter, ViewportScalesAndMoves) {
  const Viewport viewport = Viewport::fitted(100, 100, 400, 200); // scale 2, offset (100, 0)
  const Picture circle = paintCircle(stroked(kRed, 2, StrokeAlign::Centered), {10, 20}, 5, viewport);
  ASSERT_EQ(circle.primitives.size(), 1U);
  EXPECT_EQ(circle.primitives[0].center, Vec2(120, 40));
  EXPECT_EQ(circle.primitives[0].inner, 8.0);
  EXPECT_EQ(circle.primitives[0].outer, 12.0);
  const Picture box = paintRectangle(filled(kRed), {10, 20}, {30, 40}, viewport);
  EXPECT_EQ(box.primitives.at(0).low, Vec2(120, 40));
  EXPECT_EQ(box.primitives.at(0).high, Vec2(180, 120));
}

TEST(Painter, DefaultPatternIsStretchedOnceOverTheShapeWithoutItsStroke) {
  Look look = filled(pattern({0, 0, 1, 1}, true));
  look.stroke = Stroke{pattern({0, 0, 1, 1}, true), 10.0, StrokeAlign::Outside};
  const Picture picture = paintCircle(look, {100, 80}, 30);
  ASSERT_EQ(picture.patterns.size(), 2U);
  EXPECT_EQ(picture.primitives.at(0).pattern, 0);
  EXPECT_EQ(picture.primitives.at(1).pattern, 1);
  for (const PlacedPattern& placed : picture.patterns) {
    EXPECT_EQ(placed.origin, Vec2(70, 50));
    EXPECT_EQ(placed.size, Vec2(60, 60));
  }
  EXPECT_FALSE(picture.patterns[0].repeat);
  EXPECT_TRUE(picture.patterns[1].repeat) << "a stroke reaches beyond the bounds";
  EXPECT_EQ(picture.patterns[0].image, picture.patterns[1].image) << "the file is decoded once";
}

TEST(Painter, ProportionalAnchorsThatDoNotCoverTheShapeTile) {
  const auto placed = [](std::array<double, 4> anchor) {
    return paintRectangle(filled(pattern(anchor, true)), {10, 20}, {40, 60}).patterns.at(0);
  };
  EXPECT_TRUE(placed({0, 0, 0.5, 1}).repeat);
  EXPECT_TRUE(placed({0.1, 0, 1, 1}).repeat);
  EXPECT_FALSE(placed({-0.5, -0.5, 2, 2}).repeat);
  EXPECT_EQ(placed({0.25, 0.5, 0.5, 0.25}).origin, Vec2(20, 50));
  EXPECT_EQ(placed({0.25, 0.5, 0.5, 0.25}).size, Vec2(20, 15));
}

TEST(Painter, AbsoluteAnchorsStayWhileTheShapeMovesAndScaleWithTheView) {
  const Look look = filled(pattern({5, 7, 32, 24}, false));
  for (const double x : {100.0, 300.0}) {
    const PlacedPattern placed = paintCircle(look, {x, 80}, 30).patterns.at(0);
    EXPECT_EQ(placed.origin, Vec2(5, 7));
    EXPECT_EQ(placed.size, Vec2(32, 24));
    EXPECT_TRUE(placed.repeat);
  }
  const Viewport viewport = Viewport::fitted(100, 100, 400, 200);
  const PlacedPattern placed = paintCircle(look, {50, 50}, 30, viewport).patterns.at(0);
  EXPECT_EQ(placed.origin, Vec2(110, 14));
  EXPECT_EQ(placed.size, Vec2(64, 48));
}

TEST(Painter, BodiesAreDrawnByTheirShape) {
  Painter painter(Viewport::scaled(640, 480, 1.0), Color::rgb(255, 255, 255));
  const std::uint32_t look = painter.addLook(filled(kRed));
  Picture picture;
  painter.begin(picture);
  Body body;
  body.position = Vec2(30, 40);
  body.radius = 6;
  painter.body(picture, body, look);
  body.shape = Shape::Rectangle;
  body.size = Vec2(7, 8);
  painter.body(picture, body, look);
  ASSERT_EQ(picture.primitives.size(), 2U);
  EXPECT_EQ(picture.primitives[0].kind, Primitive::Kind::Disc);
  EXPECT_EQ(picture.primitives[1].kind, Primitive::Kind::Box);
  EXPECT_EQ(picture.primitives[1].high, Vec2(37, 48));
}

TEST(Painter, MissingImagesAreReportedWhenTheLookIsAdded) {
  Painter painter(Viewport::scaled(640, 480, 1.0), Color::rgb(255, 255, 255));
  ImagePattern missing;
  missing.file = kAssets / "missing.png";
  EXPECT_THROW(painter.addLook(filled(missing)), Error);
}

TEST(Painter, UnknownLooksAreRefused) {
  const Painter painter(Viewport::scaled(640, 480, 1.0), Color::rgb(255, 255, 255));
  Picture picture;
  painter.begin(picture);
  EXPECT_THROW(painter.circle(picture, {5, 5}, 3, 0), std::out_of_range);
}

} // namespace
} // namespace offstage
