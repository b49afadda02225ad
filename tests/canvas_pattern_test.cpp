#include "render/raster/area_reduce.h"
#include "render/raster/canvas.h"
#include "render/raster/image_detail.h"
#include "src/sim/error.h"
#include "tests/support/canvas_pictures.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace offstage {
namespace {

using namespace offstage::test;

std::shared_ptr<const Image> image(int width, int height, std::vector<std::uint8_t> rgba) {
  return std::make_shared<const Image>(Image{width, height, std::move(rgba)});
}

/// Black and white columns, one texel each.
std::shared_ptr<const Image> stripes(int width, int height) {
  auto result = std::make_shared<Image>(Image{width, height, {}});
  for (int i = 0; i < width * height; ++i) {
    const std::uint8_t value = i % width % 2 == 0 ? 0 : 255;
    result->rgba.insert(result->rgba.end(), {value, value, value, 255});
  }
  return result;
}

TEST(CanvasPattern, AtItsOwnSizeItIsCopiedExactly) {
  const auto source = colorfulImage(31, 17, false);
  Picture picture = blankPicture(40, 30);
  addPatternBox(picture, source, {5, 6}, {36, 23}, {31, 17}, false);
  const Frame frame = drawOnce(picture);
  for (int y = 0; y < 17; ++y) {
    for (int x = 0; x < 31; ++x) {
      const Frame texels{31, 17, source->rgba};
      ASSERT_EQ(pixel(frame, x + 5, y + 6), pixel(texels, x, y)) << x << ", " << y;
    }
  }
}

TEST(CanvasPattern, EnlargedItIsInterpolatedBetweenTexelCentres) {
  const auto two = image(2, 1, {0, 100, 200, 255, 255, 200, 0, 255});
  Picture picture = blankPicture(8, 1);
  addPatternBox(picture, two, {0, 0}, {8, 1}, {8, 1}, false); // texel centres at 2 and 6 px
  const Frame frame = drawOnce(picture);
  for (int x = 0; x < 8; ++x) {
    const double part = std::clamp((x + 0.5 - 2.0) / 4.0, 0.0, 1.0);
    EXPECT_NEAR(pixel(frame, x, 0).r, 255.0 * part, 0.51) << x;
    EXPECT_NEAR(pixel(frame, x, 0).g, 100.0 + 100.0 * part, 0.51) << x;
    EXPECT_NEAR(pixel(frame, x, 0).b, 200.0 - 200.0 * part, 0.51) << x;
  }
}

TEST(CanvasPattern, TilesRepeatInBothDirectionsAndInterpolateAcrossTheirSeam) {
  const auto two = image(2, 1, {0, 0, 0, 255, 200, 200, 200, 255});
  Picture picture = blankPicture(24, 3);
  addPatternBox(picture, two, {0, 0}, {24, 3}, {8, 3}, true);
  picture.patterns[0].origin = Vec2(16, 3); // the shape lies before the origin too
  const Frame frame = drawOnce(picture);
  for (int x = 0; x < 24; ++x) {
    const double at = (x % 8 + 0.5) / 4.0 - 0.5; // texels from the first one's centre
    const double expected = 200.0 * (at < 0 ? -at : at <= 1 ? at : 2.0 - at);
    EXPECT_NEAR(pixel(frame, x, 1).g, expected, 0.51) << x;
  }
}

TEST(CanvasPattern, TilesFarFromTheirOriginAreAsExact) {
  const auto source = colorfulImage(16, 16, false);
  Picture near = blankPicture(64, 16);
  addPatternBox(near, source, {0, 0}, {64, 16}, {20, 20}, true);
  Picture far = near;
  far.patterns[0].origin = Vec2(-20.0 * 1e7, 20.0 * 1e7);
  EXPECT_EQ(drawOnce(near).hash(), drawOnce(far).hash());
}

TEST(CanvasPattern, ColourOfTransparentTexelsDoesNotBleed) {
  const auto edge = image(2, 1, {255, 0, 0, 0, 0, 0, 255, 255}); // transparent red beside opaque blue
  Picture picture = blankPicture(8, 1, {0, 0, 0, 0});
  addPatternBox(picture, edge, {0, 0}, {8, 1}, {8, 1}, false);
  const Frame frame = drawOnce(picture);
  for (int x = 0; x < 8; ++x) {
    EXPECT_EQ(pixel(frame, x, 0).r, 0) << x;
    if (x > 1) {
      EXPECT_EQ(pixel(frame, x, 0).b, 255) << x;
    }
  }
  EXPECT_NEAR(pixel(frame, 3, 0).a, 255.0 * 1.5 / 4.0, 0.51);
}

TEST(CanvasPattern, AlphaOfTheLookMultipliesTheImage) {
  const auto grey = image(1, 1, {100, 100, 100, 128});
  Picture picture = blankPicture(2, 2);
  addPatternBox(picture, grey, {0, 0}, {2, 2}, {2, 2}, false, 127);
  const double alpha = 128.0 / 255.0 * 127.0 / 255.0;
  EXPECT_NEAR(pixel(drawOnce(picture), 1, 1).r, 100.0 * alpha + 255.0 * (1.0 - alpha), 1.0);
}

TEST(CanvasPattern, HugeImagesDrawnSmallAreAveragedAndDoNotShimmer) {
  // Columns of one texel at 20:1 and more: any of JavaFX's samples would be black, white or grey by chance.
  Canvas canvas(64, 6);
  Frame frame;
  const auto source = stripes(1000, 4);
  for (const double width : {50.0, 43.7, 20.0, 3.3}) {
    for (const double offset : {0.0, 0.13, 0.5, 0.77}) {
      Picture picture = blankPicture(64, 6);
      addPatternBox(picture, source, {4 + offset, 0}, {4 + offset + width, 6}, {width, 6}, false);
      canvas.draw(picture, frame);
      for (int x = 6; x < 3 + static_cast<int>(width); ++x) {
        EXPECT_NEAR(pixel(frame, x, 3).g, 127.5, 8.0)
            << "width " << width << " offset " << offset << " x " << x;
      }
    }
  }
}

/// Squares of `square` texels, black and white in turns.
std::shared_ptr<const Image> checkerboard(int side, int square) {
  const auto length = static_cast<std::size_t>(side);
  std::vector<std::uint8_t> rgba(4 * length * length, 255);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if ((x / square + y / square) % 2 == 0) continue;
      const std::size_t texel = 4 * (static_cast<std::size_t>(y) * length + static_cast<std::size_t>(x));
      std::fill_n(rgba.begin() + static_cast<std::ptrdiff_t>(texel), 3, std::uint8_t{0});
    }
  }
  return image(side, side, std::move(rgba));
}

TEST(CanvasPattern, DetailFinerThanThePixelsIsAveragedAtAnyReduction) {
  Canvas canvas(64, 64);
  Frame frame;
  for (const double reduction : {2.0, 2.6, 3.2, 5.0, 7.9}) {
    int darkest = 255;
    int lightest = 0;
    for (int step = 0; step < 20; ++step) {
      Picture picture = blankPicture(64, 64);
      const Vec2 low(4.0 + 0.11 * step, 5.0 + 0.07 * step);
      const Vec2 size(160.0 / reduction, 160.0 / reduction);
      addPatternBox(picture, checkerboard(160, 1), low, low + size, size, false);
      canvas.draw(picture, frame);
      const int edge = std::min(60, 4 + static_cast<int>(size.x()));
      for (int y = 10; y < edge - 3; ++y) {
        for (int x = 10; x < edge - 3; ++x) {
          darkest = std::min<int>(darkest, pixel(frame, x, y).r);
          lightest = std::max<int>(lightest, pixel(frame, x, y).r);
        }
      }
    }
    // Averaging over r texels of a checkerboard leaves at most 1/r² of its contrast; interpolation leaves all
    // of it.
    const double most = 127.5 / (reduction * reduction) + 2.0;
    EXPECT_GE(darkest, 127.5 - most) << reduction << ":1";
    EXPECT_LE(lightest, 127.5 + most) << reduction << ":1";
  }
}

TEST(ImageDetail, IsAllOfACheckerboardFromTwiceItsSquaresOn) {
  const std::vector<double> detail = imageDetail(*checkerboard(64, 4));
  ASSERT_EQ(detail.size(), 7U);
  const double all = 127.5 * std::sqrt(3.0 / 4.0); // three of four channels vary
  for (std::size_t k = 0; k < detail.size(); ++k)
    EXPECT_NEAR(detail[k], k <= 2 ? 0.0 : all, 1e-6) << "2^" << k;
}

TEST(ImageDetail, OfOneTexelAndOfOneColourIsNothing) {
  EXPECT_EQ(imageDetail(*checkerboard(1, 1)), std::vector<double>{0.0});
  for (const double loss : imageDetail(*checkerboard(5, 8))) EXPECT_NEAR(loss, 0.0, 1e-6);
}

TEST(CanvasPattern, TilesSmallerThanAPixelShowTheImagesMean) {
  for (const double size : {0.9, 0.1, 1e-6, 1e-300}) {
    Picture picture = blankPicture(8, 8);
    addPatternBox(picture, stripes(64, 8), {0, 0}, {8, 8}, {size, size}, true);
    EXPECT_NEAR(pixel(drawOnce(picture), 5, 5).g, 127.5, 0.51) << "tiles of " << size << " px";
  }
}

TEST(CanvasPattern, OriginsBeyondAllMeasureStillTile) {
  const auto source = colorfulImage(8, 8, false);
  for (const double far : {1e15, -1e100, 1e308}) {
    Picture picture = blankPicture(8, 8);
    addPatternBox(picture, source, {0, 0}, {8, 8}, {8, 8}, true);
    picture.patterns[0].origin = Vec2(far, far);
    EXPECT_EQ(pixel(drawOnce(picture), 3, 3).a, 255) << far;
    EXPECT_NE(drawOnce(picture).hash(), drawOnce(blankPicture(8, 8)).hash()) << far;
  }
}

TEST(CanvasPattern, WindowGrowsWithoutAJump) {
  // From JavaFX's two texels (up to 8:1) to the pixel's area (from 16:1).
  const auto source = colorfulImage(256, 4, false);
  Canvas canvas(8, 4);
  Frame frame;
  int previous = -1;
  for (int i = 0; i < 1000; ++i) {
    const double width = 34.0 - 0.02 * i;
    Picture picture = blankPicture(8, 4);
    addPatternBox(picture, source, {0, 0}, {8, 4}, {width, 4}, false);
    canvas.draw(picture, frame);
    const int value = pixel(frame, 0, 1).b;
    if (previous >= 0) {
      EXPECT_NEAR(value, previous, 12) << "width " << width;
    }
    previous = value;
  }
}

TEST(CanvasPattern, ManyImagesInOnePictureKeepTheirOwnTexels) {
  Picture picture = blankPicture(64, 64);
  for (int i = 0; i < 4096; ++i) {
    const auto byte = [&](int shift) { return static_cast<std::uint8_t>(i * 7 >> shift); };
    const Vec2 low(i % 64, i / 64);
    addPatternBox(picture, image(1, 1, {byte(0), byte(3), byte(6), 255}), low, low + Vec2(1, 1), {1, 1},
                  false);
  }
  const Frame frame = drawOnce(picture);
  for (int i = 0; i < 4096; ++i) {
    ASSERT_EQ(pixel(frame, i % 64, i / 64),
              pixel({1, 1, picture.patterns[static_cast<std::size_t>(i)].image->rgba}, 0, 0))
        << "image " << i;
  }
}

TEST(CanvasPattern, LargestImagesAreDrawn) {
  auto wide = std::make_shared<Image>(Image{16384, 1, {}});
  wide->rgba.assign(4UL * 16384, 255);
  wide->rgba[4UL * 16383] = 7;
  Picture picture = blankPicture(4, 1);
  addPatternBox(picture, wide, {0, 0}, {4, 1}, {16384, 1}, false);
  picture.patterns[0].origin = Vec2(-16380, 0);
  const Frame frame = drawOnce(picture);
  EXPECT_EQ(pixel(frame, 2, 0).r, 255);
  EXPECT_EQ(pixel(frame, 3, 0).r, 7);
}

TEST(AreaReduce, OwnSizeIsPremultipliedAndRounded) {
  const Image source{2, 1, {255, 128, 1, 255, 200, 100, 50, 128}};
  EXPECT_EQ(areaReduce(source, 2, 1), (std::vector<std::uint8_t>{255, 128, 1, 255, 100, 50, 25, 128}));
}

TEST(AreaReduce, OddSizesAreWeightedByArea) {
  const Image source{3, 1, {0, 0, 0, 255, 90, 90, 90, 255, 240, 240, 240, 255}};
  // Each result covers 1.5 texels: (0·1 + 90·0.5)/1.5 and (90·0.5 + 240·1)/1.5.
  EXPECT_EQ(areaReduce(source, 2, 1), (std::vector<std::uint8_t>{30, 30, 30, 255, 190, 190, 190, 255}));
}

TEST(AreaReduce, MeansOfAnImageStayItsMean) {
  const auto source = colorfulImage(61, 37, false);
  const auto mean = [](const std::vector<std::uint8_t>& rgba) {
    double sum = 0.0;
    for (std::size_t i = 0; i < rgba.size(); i += 4) sum += rgba[i];
    return 4.0 * sum / static_cast<double>(rgba.size());
  };
  for (const auto& [width, height] : {std::pair{31, 19}, {61, 1}, {1, 37}, {1, 1}, {7, 5}}) {
    EXPECT_NEAR(mean(areaReduce(*source, width, height)), mean(source->rgba), 0.6) << width << "x" << height;
  }
}

} // namespace
} // namespace offstage
