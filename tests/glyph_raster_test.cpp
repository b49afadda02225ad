#include "render/draw/glyph_raster.h"

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

int at(const Mask& mask, int x, int y) {
  return mask.coverage.at(static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) +
                          static_cast<std::size_t>(x));
}

/// Whether a point lies in a triangle, whichever way round it goes.
bool inside(const Polygon& triangle, const Vec2& p) {
  int left = 0;
  int right = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 edge = triangle[(i + 1) % 3] - triangle[i];
    const Vec2 d = p - triangle[i];
    const double side = edge.x() * d.y() - edge.y() * d.x();
    left += side > 0.0 ? 1 : 0;
    right += side < 0.0 ? 1 : 0;
  }
  return left == 0 || right == 0;
}

TEST(GlyphRaster, CoverageIsTheExactAreaOfARectangleBetweenPixels) {
  const Mask mask =
      fillPolygons({{Vec2(1.25, 0.5), Vec2(3.5, 0.5), Vec2(3.5, 2.25), Vec2(1.25, 2.25)}}, 5, 3);
  const std::vector<double> across{0.0, 0.75, 1.0, 0.5, 0.0};
  const std::vector<double> down{0.5, 1.0, 0.25};
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x)
      EXPECT_EQ(at(mask, x, y),
                std::lround(255.0 * across[static_cast<std::size_t>(x)] * down[static_cast<std::size_t>(y)]))
          << x << ", " << y;
}

TEST(GlyphRaster, CoverageIsTheAreaOfAnyTriangle) {
  constexpr int kSide = 9;
  constexpr int kSamples = 64; // a pixel's side: an edge is off by at most about one row of samples
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0.0, kSide);
  double worst = 0.0;
  for (int i = 0; i < 40; ++i) {
    Polygon triangle;
    for (int k = 0; k < 3; ++k) {
      const double x = place(random);
      triangle.emplace_back(x, place(random));
    }
    const Mask mask = fillPolygons({triangle}, kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        int hits = 0;
        for (int down = 0; down < kSamples; ++down) {
          for (int across = 0; across < kSamples; ++across) {
            const Vec2 sample(x + (across + 0.5) / kSamples, y + (down + 0.5) / kSamples);
            hits += inside(triangle, sample) ? 1 : 0;
          }
        }
        const double share = static_cast<double>(hits) / (kSamples * kSamples);
        worst = std::max(worst, std::abs(at(mask, x, y) - 255.0 * share));
      }
    }
  }
  EXPECT_LT(worst, 255.0 / kSamples + 0.5) << "of 255";
}

TEST(GlyphRaster, AHoleGoesTheOtherWayRoundAndOverlapsCountOnce) {
  const Polygon outer{Vec2(0, 0), Vec2(6, 0), Vec2(6, 6), Vec2(0, 6)};
  const Polygon hole{Vec2(2, 2), Vec2(2, 4), Vec2(4, 4), Vec2(4, 2)};
  const Polygon again{Vec2(0, 0), Vec2(3, 0), Vec2(3, 6), Vec2(0, 6)};
  const Mask mask = fillPolygons({outer, hole}, 6, 6);
  EXPECT_EQ(at(mask, 3, 3), 0);
  EXPECT_EQ(at(mask, 1, 1), 255);
  EXPECT_EQ(at(fillPolygons({outer, again}, 6, 6), 1, 1), 255);
}

TEST(GlyphRaster, CurvesAreCutFinely) {
  // A circle of four cubic quarters; the usual constant keeps it within 3/10000 of the radius.
  constexpr double kArm = 0.5522847498;
  constexpr double kRadius = 100.0;
  const auto point = [](double x, double y) { return Vec2(x * kRadius, y * kRadius); };
  GlyphOutline circle;
  circle.contours.push_back(
      {point(1, 0),
       {{.controls = 2, .through = {point(1, kArm), point(kArm, 1)}, .to = point(0, 1)},
        {.controls = 2, .through = {point(-kArm, 1), point(-1, kArm)}, .to = point(-1, 0)},
        {.controls = 2, .through = {point(-1, -kArm), point(-kArm, -1)}, .to = point(0, -1)},
        {.controls = 2, .through = {point(kArm, -1), point(1, -kArm)}, .to = point(1, 0)}}});
  const Mask mask = fillPolygons(flatten(circle, {.scale = 0.5, .pen = {51.3, 50.7}}), 102, 102);
  const double area = std::accumulate(mask.coverage.begin(), mask.coverage.end(), 0.0) / 255.0;
  EXPECT_NEAR(area, std::acos(-1.0) * 50.0 * 50.0, 6.0) << "px², of 7854";
}

TEST(GlyphRaster, UpwardsIsAQuarterTurn) {
  GlyphOutline bar; // 4 wide, 1 high, on the baseline
  bar.contours.push_back({Vec2(0, 0), {{.to = Vec2(4, 0)}, {.to = Vec2(4, 1)}, {.to = Vec2(0, 1)}}});
  const Mask flat = fillPolygons(flatten(bar, {.scale = 1.0, .pen = {0, 1}}), 4, 1);
  const Mask turned = fillPolygons(flatten(bar, {.scale = 1.0, .pen = {1, 4}, .upwards = true}), 1, 4);
  EXPECT_EQ(flat.coverage, std::vector<std::uint8_t>(4, 255));
  EXPECT_EQ(turned.coverage, std::vector<std::uint8_t>(4, 255));
}

TEST(GlyphRaster, AnOutlineReachesAsFarAsItsPen) {
  const std::vector<Polygon> square{{Vec2(10, 10), Vec2(20, 10), Vec2(20, 20), Vec2(10, 20)}};
  const Mask fill = fillPolygons(square, 30, 30);
  const Mask outline = outlinePolygons(square, fill, 4.0);
  EXPECT_EQ(at(outline, 15, 15), 255) << "the letter is part of it";
  EXPECT_EQ(at(outline, 6, 15), 255);
  EXPECT_EQ(at(outline, 5, 15), 0);
  EXPECT_EQ(at(outline, 23, 15), 255);
  EXPECT_EQ(at(outline, 24, 15), 0);
  EXPECT_EQ(at(outline, 6, 6), 0) << "its corners are round";
}

} // namespace
} // namespace offstage::test
