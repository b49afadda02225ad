#include "render/output/yuv.h"
#include "tests/support/test_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace offstage {
namespace {

using test::errorOf;
using test::flatFrame;
using test::noiseFrame;

/// ITU-R BT.709-6, section 3, in doubles and not rounded.
std::array<double, 3> referenceYuv(double red, double green, double blue) {
  const double y = (0.2126 * red + 0.7152 * green + 0.0722 * blue) / 255.0;
  return {219.0 * y + 16.0, 224.0 * (blue / 255.0 - y) / 1.8556 + 128.0,
          224.0 * (red / 255.0 - y) / 1.5748 + 128.0};
}

/// The way back, in doubles.
std::array<double, 3> referenceRgb(double y, double cb, double cr) {
  const double luma = (y - 16.0) / 219.0;
  const double red = luma + 1.5748 * (cr - 128.0) / 224.0;
  const double blue = luma + 1.8556 * (cb - 128.0) / 224.0;
  return {255.0 * red, 255.0 * (luma - 0.2126 * red - 0.0722 * blue) / 0.7152, 255.0 * blue};
}

struct Planes {
  std::vector<std::uint8_t> y, u, v;
  int width = 0; ///< even
  int height = 0;
  [[nodiscard]] std::uint8_t luma(int row, int column) const {
    return y[test::pixelIndex(row, width, column)];
  }
  [[nodiscard]] std::size_t chroma(int row, int column) const {
    return test::pixelIndex(row, width / 2, column);
  }
};

Planes convert(const Frame& frame) {
  Planes planes;
  planes.width = evenSize(frame.width);
  planes.height = evenSize(frame.height);
  planes.y.assign(test::pixelIndex(planes.height, planes.width, 0), 0);
  planes.u.assign(planes.y.size() / 4, 0);
  planes.v.assign(planes.y.size() / 4, 0);
  Yuv420Converter converter;
  converter.convert(frame, {planes.y.data(), planes.u.data(), planes.v.data(), planes.width, planes.width / 2,
                            planes.width / 2});
  return planes;
}

std::array<double, 3> pixel(const Frame& frame, int row, int column) {
  row = std::clamp(row, 0, frame.height - 1);
  column = std::clamp(column, 0, frame.width - 1);
  const std::uint8_t* at = &frame.rgba[test::pixelIndex(row, frame.width, column) * 4];
  return {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
}

/// Mean with weights 1 2 1 around column 2i and 1 1 over rows 2j and 2j + 1.
std::array<double, 3> chromaSource(const Frame& frame, int j, int i) {
  std::array<double, 3> sum{};
  for (int row = 2 * j; row <= 2 * j + 1; ++row) {
    for (int side = -1; side <= 1; ++side) {
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += pixel(frame, row, 2 * i + side)[c] * (side == 0 ? 2.0 : 1.0) / 8.0;
    }
  }
  return sum;
}

TEST(ColorConvert, EveryColourIsWithinRoundingOfTheRecommendation) {
  // All values of each channel in steps that meet 0 and 255, as flat blocks of 2 × 2 pixels in a column two
  // wide.
  double worstLuma = 0.0;
  double worstChroma = 0.0;
  Frame frame = flatFrame(2, 2 * 52 * 52, {});
  for (int red = 0; red < 256; ++red) {
    const auto at = [&](int block) { return std::array<int, 3>{red, (block / 52) * 5, (block % 52) * 5}; };
    for (int block = 0; block < 52 * 52; ++block) {
      for (std::size_t i = 0; i < 16; ++i) {
        frame.rgba[static_cast<std::size_t>(block) * 16 + i] =
            i % 4 == 3 ? 255 : static_cast<std::uint8_t>(at(block)[i % 4]);
      }
    }
    const Planes planes = convert(frame);
    for (int block = 0; block < 52 * 52; ++block) {
      const auto [r, g, b] = at(block);
      const std::array<double, 3> expected = referenceYuv(r, g, b);
      const auto index = static_cast<std::size_t>(block);
      worstLuma = std::max(worstLuma, std::abs(planes.luma(2 * block, 1) - expected[0]));
      worstChroma = std::max(
          {worstChroma, std::abs(planes.u[index] - expected[1]), std::abs(planes.v[index] - expected[2])});
    }
  }
  EXPECT_LE(worstLuma, 0.506);
  EXPECT_LE(worstChroma, 0.506);
}

TEST(ColorConvert, FlatColoursDecodeBackAndGreysHaveNoColour) {
  for (int grey = 0; grey < 256; ++grey) {
    const auto value = static_cast<std::uint8_t>(grey);
    const Planes planes = convert(flatFrame(2, 2, {value, value, value, 255}));
    EXPECT_EQ(planes.u[0], 128) << grey;
    EXPECT_EQ(planes.v[0], 128) << grey;
    EXPECT_NEAR(referenceRgb(planes.y[0], 128, 128)[0], grey, 0.6);
  }
  EXPECT_EQ(convert(flatFrame(2, 2, {255, 255, 255, 255})).y[0], 235);
  EXPECT_EQ(convert(flatFrame(2, 2, {0, 0, 0, 255})).y[0], 16);

  double worst = 0.0;
  for (int red = 0; red < 256; red += 15) {
    for (int green = 0; green < 256; green += 15) {
      for (int blue = 0; blue < 256; blue += 15) {
        const Planes planes =
            convert(flatFrame(2, 2,
                              {static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green),
                               static_cast<std::uint8_t>(blue), 255}));
        const std::array<double, 3> back = referenceRgb(planes.y[0], planes.u[0], planes.v[0]);
        worst =
            std::max({worst, std::abs(back[0] - red), std::abs(back[1] - green), std::abs(back[2] - blue)});
      }
    }
  }
  // Half a step of Y and half a step of Cb: 255/219/2 + 255·1.8556/224/2.
  EXPECT_LE(worst, 1.65);
}

TEST(ColorConvert, SaturatedPrimariesHaveTheRecommendationsCodes) {
  const auto codes = [](std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    const Planes planes = convert(flatFrame(2, 2, {red, green, blue, 255}));
    return std::array<int, 3>{planes.y[0], planes.u[0], planes.v[0]};
  };
  EXPECT_EQ(codes(255, 0, 0), (std::array<int, 3>{63, 102, 240}));
  EXPECT_EQ(codes(0, 255, 0), (std::array<int, 3>{173, 42, 26}));
  EXPECT_EQ(codes(0, 0, 255), (std::array<int, 3>{32, 240, 118}));
}

TEST(ColorConvert, ChromaIsSitedOnEvenColumnsBetweenTwoRows) {
  for (const auto& [width, height] : {std::pair{64, 32}, {37, 21}, {1, 1}, {2, 1}, {3, 2}, {1, 5}}) {
    const Frame frame = noiseFrame(width, height, static_cast<std::uint32_t>(width));
    const Planes planes = convert(frame);
    double worst = 0.0;
    for (int j = 0; j < planes.height / 2; ++j) {
      for (int i = 0; i < planes.width / 2; ++i) {
        const std::array<double, 3> source = chromaSource(frame, j, i);
        const std::array<double, 3> expected = referenceYuv(source[0], source[1], source[2]);
        worst = std::max({worst, std::abs(planes.u[planes.chroma(j, i)] - expected[1]),
                          std::abs(planes.v[planes.chroma(j, i)] - expected[2])});
      }
    }
    EXPECT_LE(worst, 0.51) << width << " × " << height;
  }
}

TEST(ColorConvert, OddSizesRepeatTheLastColumnAndRow) {
  const Frame frame = noiseFrame(7, 5, 3);
  const Planes planes = convert(frame);
  ASSERT_EQ(planes.width, 8);
  ASSERT_EQ(planes.height, 6);
  for (int row = 0; row < 6; ++row) EXPECT_EQ(planes.luma(row, 7), planes.luma(row, 6)) << row;
  for (int column = 0; column < 8; ++column)
    EXPECT_EQ(planes.luma(5, column), planes.luma(4, column)) << column;
}

TEST(ColorConvert, HonoursStridesAndWritesNothingBeside) {
  const Frame frame = noiseFrame(10, 4, 9);
  const Planes tight = convert(frame);
  std::vector<std::uint8_t> y(4 * 16, 77);
  std::vector<std::uint8_t> u(2 * 8, 77);
  std::vector<std::uint8_t> v(2 * 9, 77);
  Yuv420Converter converter;
  converter.convert(frame, {y.data(), u.data(), v.data(), 16, 8, 9});
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 16; ++column) {
      EXPECT_EQ(y[row * 16 + column], column < 10 ? tight.y[row * 10 + column] : 77) << row << ' ' << column;
    }
  }
  for (std::size_t row = 0; row < 2; ++row) {
    for (std::size_t column = 0; column < 9; ++column) {
      if (column < 8) {
        EXPECT_EQ(u[row * 8 + column], column < 5 ? tight.u[row * 5 + column] : 77) << row << ' ' << column;
      }
      EXPECT_EQ(v[row * 9 + column], column < 5 ? tight.v[row * 5 + column] : 77);
    }
  }
}

/// The frame `after`, told to differ from `before` in these rectangles; elsewhere it holds `before`'s pixels.
Frame damaged(const Frame& before, Frame after, const std::vector<PixelRect>& damage) {
  const Frame whole = after;
  after.rgba = before.rgba;
  for (const PixelRect& rect : damage) {
    for (int row = rect.top; row < rect.bottom; ++row) {
      const auto begin = static_cast<std::ptrdiff_t>(test::pixelIndex(row, after.width, rect.left) * 4);
      std::copy_n(whole.rgba.begin() + begin, (rect.right - rect.left) * 4, after.rgba.begin() + begin);
    }
  }
  after.base = before.id;
  after.damage = damage;
  return after;
}

TEST(ColorConvert, DamagedPartsGiveTheBytesOfAWholeConversion) {
  for (const auto& [width, height] : {std::pair{64, 48}, {63, 47}, {65, 33}, {5, 5}, {1, 1}}) {
    Planes planes;
    planes.width = evenSize(width);
    planes.height = evenSize(height);
    planes.y.assign(test::pixelIndex(planes.height, planes.width, 0), 0);
    planes.u.assign(planes.y.size() / 4, 0);
    planes.v.assign(planes.y.size() / 4, 0);
    Yuv420Converter converter;
    Frame before = noiseFrame(width, height, 1);
    before.id = 1;
    std::uint32_t seed = 2;
    const auto random = [&seed](int limit) {
      seed = seed * 1664525U + 1013904223U;
      return static_cast<int>((seed >> 8U) % static_cast<std::uint32_t>(limit));
    };
    for (std::uint64_t id = 1; id < 60; ++id) {
      Frame frame = before;
      if (id > 1) {
        std::vector<PixelRect> damage;
        for (int i = random(3); i > 0; --i) {
          const int left = random(width);
          const int top = random(height);
          damage.push_back({left, top, left + 1 + random(width - left), top + 1 + random(height - top)});
        }
        frame = damaged(before, noiseFrame(width, height, seed), damage);
        frame.id = id;
      }
      converter.convert(frame, {planes.y.data(), planes.u.data(), planes.v.data(), planes.width,
                                planes.width / 2, planes.width / 2});
      const Planes whole = convert(frame);
      ASSERT_EQ(planes.y, whole.y) << width << " × " << height << ", frame " << id;
      ASSERT_EQ(planes.u, whole.u) << width << " × " << height << ", frame " << id;
      ASSERT_EQ(planes.v, whole.v) << width << " × " << height << ", frame " << id;
      before = frame;
    }
  }
}

TEST(ColorConvert, DamageOfAnotherFrameCountsForNothing) {
  const Frame first = flatFrame(16, 16, {10, 20, 30, 255});
  Frame other = noiseFrame(16, 16, 4);
  other.id = 9;
  other.base = 7; // not what was converted before
  Planes planes = convert(first);
  Yuv420Converter converter;
  for (const Frame* frame : {static_cast<const Frame*>(&first), static_cast<const Frame*>(&other)})
    converter.convert(*frame, {planes.y.data(), planes.u.data(), planes.v.data(), 16, 8, 8});
  EXPECT_EQ(planes.y, convert(other).y);
}

TEST(ColorConvert, RefusesATornFrame) {
  Frame torn = flatFrame(4, 4, {});
  torn.rgba.resize(10);
  EXPECT_EQ(errorOf([&torn] { convert(torn); }), "2: a frame of 4 × 4 px holds 10 bytes instead of 64");
}

} // namespace
} // namespace offstage
