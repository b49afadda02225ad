#include "render/compare/compare_images.h"
#include "render/output/png.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Frame white(int width = 40, int height = 30) {
  return flatFrame(width, height, {255, 255, 255, 255});
}

void paint(Frame& frame, int x, int y, std::array<std::uint8_t, 4> rgba) {
  std::copy(rgba.begin(), rgba.end(), &frame.rgba[4 * pixelIndex(y, frame.width, x)]);
}

/// A disc on white, its edge antialiased with 8 × 8 samples.
Frame disc(double x, double y, double radius) {
  Frame frame = white();
  for (int row = 0; row < frame.height; ++row) {
    for (int column = 0; column < frame.width; ++column) {
      int hits = 0;
      for (int down = 0; down < 8; ++down)
        for (int across = 0; across < 8; ++across)
          if (std::hypot(column + (across + 0.5) / 8 - x, row + (down + 0.5) / 8 - y) < radius) ++hits;
      const auto grey = static_cast<std::uint8_t>(255 - hits * 255 / 64);
      paint(frame, column, row, {grey, grey, grey, 255});
    }
  }
  return frame;
}

TEST(CompareImages, EqualFramesAreTheSame) {
  const Frame frame = noiseFrame(70, 50, 1);
  const Comparison found = compareImages(frame, frame, {}, Metrics::All);
  EXPECT_TRUE(found.same());
  EXPECT_EQ(found.compared, 3500);
  EXPECT_EQ(found.differing, 0);
  EXPECT_EQ(found.unequal, 0);
  EXPECT_TRUE(std::isinf(found.psnr));
  EXPECT_EQ(found.ssim, 1.0);
  EXPECT_EQ(found.pixelmatch, 0);
  EXPECT_EQ(found.flip->max, 0.0);
  EXPECT_THAT(found.failures, IsEmpty());
  EXPECT_THAT(found.worst, IsEmpty());
}

TEST(CompareImages, OnePixelIsFoundWithAllItsNumbers) {
  const Frame expected = white();
  Frame actual = expected;
  paint(actual, 7, 9, {255, 250, 155, 255});
  const Comparison found = compareImages(expected, actual);
  EXPECT_EQ(found.kind, Comparison::Kind::Differs);
  EXPECT_EQ(found.differing, 1);
  EXPECT_DOUBLE_EQ(found.ratio, 1.0 / 1200.0);
  EXPECT_EQ(found.box, (PixelRect{7, 9, 8, 10}));
  EXPECT_EQ(found.clusters, 1);
  EXPECT_EQ(found.largestCluster, 1);
  EXPECT_EQ(found.maxChannel, 100.0);
  EXPECT_DOUBLE_EQ(found.meanChannel, 105.0 / 3600.0);
  EXPECT_DOUBLE_EQ(found.rms, std::sqrt((25.0 + 10000.0) / 3600.0));
  EXPECT_NEAR(found.psnr, 20.0 * std::log10(255.0 / std::sqrt(10025.0 / 3600.0)), 1e-9);
  ASSERT_EQ(found.worst.size(), 1U);
  EXPECT_EQ(found.worst[0].x, 7);
  EXPECT_EQ(found.worst[0].y, 9);
  EXPECT_THAT(found.worst[0].actual, ElementsAre(255, 250, 155, 255));
  EXPECT_THAT(found.failures, ElementsAre("1 px differ, 0 allowed"));
}

TEST(CompareImages, SmallThingsAreFoundAtTolerance0) {
  EXPECT_FALSE(compareImages(disc(20, 15, 3), disc(20.5, 15, 3)).same())
      << "a ball of radius 3, half a pixel";
  Frame minus = white();
  for (int x = 10; x < 15; ++x) paint(minus, x, 12, {0, 0, 0, 255});
  EXPECT_EQ(compareImages(minus, white()).largestCluster, 5) << "a missing minus sign";
  const Comparison shifted = compareImages(flatFrame(9, 9, {7, 8, 9, 255}), flatFrame(9, 9, {8, 7, 10, 255}));
  EXPECT_EQ(shifted.differing, 81) << "all colours off by one";
  EXPECT_EQ(shifted.maxChannel, 1.0);
}

TEST(CompareImages, TheTenWorstComeWorstFirstAndThenInReadingOrder) {
  const Frame expected = white(60, 60);
  Frame actual = expected;
  for (int i = 0; i < 30; ++i)
    paint(actual, (i * 17) % 60, 2 * i, {static_cast<std::uint8_t>(255 - 10 * (i % 15)), 255, 255, 255});
  paint(actual, 0, 0, {255, 255, 255, 255});
  const Comparison found = compareImages(expected, actual);
  ASSERT_EQ(found.worst.size(), 10U);
  EXPECT_EQ(found.worst[0].difference, 140.0);
  for (std::size_t i = 1; i < 10; ++i) {
    const PixelPair& a = found.worst[i - 1];
    const PixelPair& b = found.worst[i];
    EXPECT_TRUE(a.difference > b.difference || (a.difference == b.difference && a.y < b.y)) << i;
  }
}

TEST(CompareImages, AnotherSizeIsAResultOfItsOwn) {
  const Comparison found = compareImages(white(40, 30), white(41, 30));
  EXPECT_EQ(found.kind, Comparison::Kind::SizeDiffers);
  EXPECT_THAT(found.failures, ElementsAre("size differs: expected 40x30 px, actual 41x30 px"));
}

TEST(CompareImages, ColoursUnderAlpha0AreEqualUnlessStrict) {
  const Frame a = flatFrame(5, 5, {10, 20, 30, 0});
  const Frame b = flatFrame(5, 5, {99, 88, 77, 0});
  EXPECT_TRUE(compareImages(a, b).same());
  Tolerance strict;
  strict.strictAlpha = true;
  EXPECT_EQ(compareImages(a, b, strict).maxChannel, 89.0);
  const Comparison faint = compareImages(a, flatFrame(5, 5, {99, 88, 77, 3}));
  EXPECT_FALSE(faint.same());
  EXPECT_EQ(faint.maxChannel, 3.0) << "only what can be seen counts";
}

Comparison compareWith(const Tolerance& tolerance, int differing, std::uint8_t by) {
  const Frame expected = white();
  Frame actual = expected;
  for (int i = 0; i < differing; ++i)
    paint(actual, 3 * i, 5, {static_cast<std::uint8_t>(255 - by), 255, 255, 255});
  return compareImages(expected, actual, tolerance);
}

TEST(Tolerances, EachLimitAllowsWhatItSaysAndNoMore) {
  EXPECT_TRUE(compareWith({.maxChannel = 4}, 5, 4).same());
  EXPECT_FALSE(compareWith({.maxChannel = 4}, 5, 5).same());
  EXPECT_EQ(compareWith({.maxChannel = 4}, 5, 4).unequal, 5);
  EXPECT_TRUE(compareWith({.maxPixels = 5}, 5, 200).same());
  EXPECT_FALSE(compareWith({.maxPixels = 4}, 5, 200).same());
  EXPECT_TRUE(compareWith({.maxRatio = 5.0 / 1200.0}, 5, 200).same());
  EXPECT_FALSE(compareWith({.maxRatio = 4.9 / 1200.0}, 5, 200).same());
  EXPECT_TRUE(compareWith({.maxCluster = 1}, 5, 200).same());
  EXPECT_FALSE(compareWith({.maxCluster = 0}, 5, 200).same());
  EXPECT_FALSE(compareWith({.maxPixels = 9, .maxCluster = 0}, 5, 200).same()) << "every limit has to hold";
  EXPECT_TRUE(compareWith({.flipMax = 1.0}, 5, 200).same());
  EXPECT_FALSE(compareWith({.flipMax = 0.1}, 5, 200).same());
  EXPECT_TRUE(compareWith({.ssimMin = 0.5}, 5, 20).same());
  EXPECT_FALSE(compareWith({.ssimMin = 0.99999999}, 5, 200).same());
  EXPECT_FALSE(compareWith({.maxChannel = 4, .flipMax = 1.0}, 5, 200).same());
}

TEST(Tolerances, IgnoredRegionsAndMasksAreNotCompared) {
  const TempDir dir;
  const Frame expected = white();
  Frame actual = expected;
  paint(actual, 3, 4, {0, 0, 0, 255});
  paint(actual, 39, 29, {0, 0, 0, 255});
  Tolerance tolerance;
  tolerance.ignore = {{3, 4, 1, 1}};
  EXPECT_EQ(compareImages(expected, actual, tolerance).differing, 1);
  tolerance.ignore.push_back({-5, 20, 5 + 40, 100});
  const Comparison found = compareImages(expected, actual, tolerance, Metrics::All);
  EXPECT_TRUE(found.same());
  EXPECT_EQ(found.ignored, 1 + 40 * 10);
  EXPECT_EQ(found.flip->max, 0.0);
  EXPECT_EQ(found.ssim, 1.0);
  EXPECT_EQ(found.pixelmatch, 0);

  Frame mask = flatFrame(40, 30, {0, 0, 0, 0});
  paint(mask, 3, 4, {0, 0, 0, 255});
  paint(mask, 39, 29, {100, 100, 100, 255});
  const std::vector<std::uint8_t> png = encodePng(mask, true);
  Tolerance masked;
  masked.masks = {dir.write("mask.png", std::string(png.begin(), png.end()))};
  EXPECT_TRUE(compareImages(expected, actual, masked).same());
  EXPECT_EQ(compareImages(expected, actual, masked).ignored, 2);
  EXPECT_THAT(errorOf([&] { compareImages(white(9, 9), white(9, 9), masked); }),
              HasSubstr("is 40x30 px, the pictures are 9x9"));
}

TEST(Tolerances, ForgivenAntialiasingIsCountedShownAndCapped) {
  const Frame expected = disc(20, 15, 8);
  const Frame actual = disc(20.3, 15, 8);
  Tolerance forgiving;
  forgiving.ignoreAntialiasing = true;
  const Comparison strict = compareImages(expected, actual);
  const Comparison found = compareImages(expected, actual, forgiving);
  EXPECT_GT(found.forgiven, 10);
  EXPECT_EQ(found.forgiven + found.differing, strict.differing);
  ASSERT_TRUE(found.worstForgiven.has_value());
  EXPECT_GT(found.worstForgiven->difference, 20.0);
  EXPECT_EQ(found.maxChannel, strict.maxChannel) << "what is forgiven is not hidden";
  forgiving.maxPixels = found.differing;
  EXPECT_TRUE(compareImages(expected, actual, forgiving).same());
  forgiving.maxForgiven = found.forgiven - 1;
  EXPECT_THAT(compareImages(expected, actual, forgiving).failures,
              ElementsAre(HasSubstr("forgiven as antialiasing")));
  const Frame picture = Comparer(forgiving, Metrics::Fast, 1).difference(expected, actual);
  int yellow = 0;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    if (picture.rgba[i] == 255 && picture.rgba[i + 1] == 214 && picture.rgba[i + 2] == 0) ++yellow;
  EXPECT_EQ(yellow, found.forgiven);
}

TEST(Strip, ShowsExpectedDifferenceAndActual) {
  const Frame expected = white(10, 8);
  Frame actual = expected;
  paint(actual, 2, 3, {0, 0, 0, 255});
  Comparer comparer({}, Metrics::Fast, 1);
  const Frame strip = makeStrip(expected, comparer.difference(expected, actual), actual);
  EXPECT_EQ(strip.width, 3 * 10 + 2 * 8);
  EXPECT_EQ(strip.height, 8);
  const auto at = [&](int x, int y) {
    const std::uint8_t* p = &strip.rgba[4 * pixelIndex(y, strip.width, x)];
    return std::vector<int>{p[0], p[1], p[2]};
  };
  EXPECT_THAT(at(2, 3), ElementsAre(255, 255, 255));
  EXPECT_THAT(at(18 + 2, 3), ElementsAre(255, 0, 0));
  EXPECT_THAT(at(18 + 3, 3), ElementsAre(255, 255, 255));
  EXPECT_THAT(at(36 + 2, 3), ElementsAre(0, 0, 0));
}

} // namespace
} // namespace offstage::test
