#include "render/draw/picture.h"

#include <limits>

#include <gtest/gtest.h>

namespace offstage {
namespace {

TEST(Viewport, ScaledRoundsToWholePixelsAndAtLeastOne) {
  const Viewport same = Viewport::scaled(640, 480, 1.0);
  EXPECT_EQ(same.width, 640);
  EXPECT_EQ(same.height, 480);
  EXPECT_EQ(same.scale, 1.0);
  EXPECT_EQ(same.offset, Vec2(0, 0));
  EXPECT_EQ(same.clip, (PixelRect{0, 0, 640, 480}));
  const Viewport half = Viewport::scaled(641, 479, 0.5);
  EXPECT_EQ(half.width, 321); // 320.5 rounds up
  EXPECT_EQ(half.height, 240);
  const Viewport tiny = Viewport::scaled(640, 480, 1e-9);
  EXPECT_EQ(tiny.width, 1);
  EXPECT_EQ(tiny.height, 1);
}

TEST(Viewport, ScaledToMoreThanAnIntegerHoldsStaysRefusable) {
  const Viewport viewport = Viewport::scaled(640, 480, 1e300);
  EXPECT_EQ(viewport.width, 1000000000);
  EXPECT_EQ(viewport.height, 1000000000);
}

TEST(Viewport, FittedIsCentredOnWholePixels) {
  const Viewport wide = Viewport::fitted(640, 480, 1920, 1080);
  EXPECT_DOUBLE_EQ(wide.scale, 2.25);
  EXPECT_EQ(wide.offset, Vec2(240, 0));
  EXPECT_EQ(wide.clip, (PixelRect{240, 0, 1680, 1080}));
  const Viewport tall = Viewport::fitted(640, 480, 101, 201);
  EXPECT_DOUBLE_EQ(tall.scale, 101.0 / 640.0);
  EXPECT_EQ(tall.offset, Vec2(0, 62));
  EXPECT_EQ(tall.clip, (PixelRect{0, 62, 101, 138}));
  EXPECT_EQ(tall.width, 101);
  EXPECT_EQ(tall.height, 201);
}

TEST(Viewport, FittedToThePaneItselfChangesNothing) {
  const Viewport viewport = Viewport::fitted(641, 479, 641, 479);
  EXPECT_EQ(viewport.scale, 1.0);
  EXPECT_EQ(viewport.offset, Vec2(0, 0));
  EXPECT_EQ(viewport.clip, (PixelRect{0, 0, 641, 479}));
}

TEST(Picture, ClearKeepsTheMemory) {
  Picture picture;
  picture.primitives.resize(100);
  picture.patterns.resize(10);
  const std::size_t primitives = picture.primitives.capacity();
  const std::size_t patterns = picture.patterns.capacity();
  picture.clear();
  EXPECT_TRUE(picture.primitives.empty());
  EXPECT_TRUE(picture.patterns.empty());
  EXPECT_EQ(picture.primitives.capacity(), primitives);
  EXPECT_EQ(picture.patterns.capacity(), patterns);
}

} // namespace
} // namespace offstage
