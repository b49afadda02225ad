#include "render/output/color_table.h"
#include "render/output/gif_palette.h"
#include "render/output/nearest_color.h"
#include "render/output/palette_dither.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

std::uint8_t levelOf(std::mt19937& random) {
  return static_cast<std::uint8_t>(random() % 256);
}

/// Every colour looked at: the first of the nearest.
std::uint8_t slowNearest(const std::vector<GifColor>& palette, const std::array<int, 3>& color) {
  int best = std::numeric_limits<int>::max();
  std::size_t index = 0;
  for (std::size_t i = 0; i < palette.size(); ++i) {
    int distance = 0;
    for (std::size_t c = 0; c < 3; ++c)
      distance += kEyeWeights[c] * (color[c] - palette[i][c]) * (color[c] - palette[i][c]);
    if (distance >= best) continue;
    best = distance;
    index = i;
  }
  return static_cast<std::uint8_t>(index);
}

TEST(NearestColor, IsWhatLookingAtEveryColourFinds) {
  std::mt19937 random(2022);
  for (const std::size_t size : {1U, 2U, 7U, 255U, 256U}) {
    std::vector<GifColor> palette(size);
    for (GifColor& color : palette) color = {levelOf(random), levelOf(random), levelOf(random)};
    palette.back() = palette.front(); // of equals the first
    NearestColor nearest(palette);
    for (int i = 0; i < 20000; ++i) {
      std::array<int, 3> color{levelOf(random), levelOf(random), levelOf(random)};
      if (i % 3 == 0) { // at and around the palette's own, where it is tight
        const GifColor& near = palette[random() % size];
        for (std::size_t c = 0; c < 3; ++c)
          color[c] = std::clamp(near[c] + static_cast<int>(random() % 3) - 1, 0, 255);
      }
      ASSERT_EQ(nearest.find(color), slowNearest(palette, color))
          << size << " colours, " << color[0] << ' ' << color[1] << ' ' << color[2];
    }
  }
}

TEST(ColorTable, HoldsWhatAMapHolds) {
  ColorTable<int> table;
  std::map<std::uint32_t, int> map;
  std::mt19937 random(7);
  for (int i = 0; i < 200000; ++i) {
    const std::uint32_t color = i % 2 == 0 ? random() % 0x1000000U : static_cast<std::uint32_t>(i) % 500U;
    ++table[color];
    ++map[color];
  }
  EXPECT_EQ(table.size(), map.size());
  std::map<std::uint32_t, int> visited;
  table.forEach([&](std::uint32_t color, int count) { visited[color] += count; });
  EXPECT_TRUE(visited == map);
  for (const auto& [color, count] : map) {
    const int* const found = table.find(color);
    ASSERT_NE(found, nullptr) << color;
    ASSERT_EQ(*found, count) << color;
  }
  EXPECT_EQ(table.find(0xFFFFFFU) != nullptr, map.contains(0xFFFFFFU));
  table.clear();
  EXPECT_EQ(table.size(), 0U);
  EXPECT_EQ(table.find(3), nullptr);
}

TEST(ColorHistogram, KeepsABackgroundsColourAmongMoreColoursThanItCounts) {
  ColorHistogram histogram;
  std::mt19937 random(1);
  for (int frame = 0; frame < 4; ++frame) {
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < 100000; ++i) {
      for (const std::uint8_t level : {levelOf(random), levelOf(random), levelOf(random)})
        pixels.push_back(level);
      pixels.push_back(255);
    }
    for (int i = 0; i < 100000; ++i) pixels.insert(pixels.end(), {255, 255, 255, 255});
    for (int i = 0; i < 20000; ++i) pixels.insert(pixels.end(), {13, 77, 201, 255});
    for (int i = 0; i < 10000; ++i) pixels.insert(pixels.end(), {1, 2, 3, 0}); // not seen
    histogram.add(pixels);
  }
  std::uint64_t all = 0;
  for (const ColorHistogram::Entry& entry : histogram.entries()) all += entry.count;
  EXPECT_EQ(all, 4U * 220000U);
  EXPECT_LT(histogram.entries().size(), 140000U);
  const std::vector<GifColor> palette = makePalette(histogram);
  EXPECT_EQ(palette.size(), 255U);
  EXPECT_EQ(palette[0], (GifColor{255, 255, 255}));
  EXPECT_EQ(palette[1], (GifColor{13, 77, 201}));
}

TEST(PaletteDither, MixesColoursToTheMeanAndLeavesWhatIsTransparent) {
  PaletteDither dither({{0, 0, 0}, {255, 255, 255}, {200, 0, 0}});
  std::vector<std::uint8_t> row;
  for (int i = 0; i < 4; ++i) row.insert(row.end(), {128, 128, 128, 255});
  int white = 0;
  for (int y = 0; y < 4; ++y) {
    std::array<std::uint8_t, 4> indices{};
    dither.indices(row, 0, y, indices.data());
    for (const std::uint8_t index : indices) white += index == 1 ? 1 : 0;
  }
  EXPECT_NEAR(white, 8, 1) << "of 16 pixels of middle grey";
  const std::vector<std::uint8_t> exact{200, 0, 0, 255, 0, 0, 0, 0, 255, 255, 255, 255};
  std::array<std::uint8_t, 3> indices{9, 9, 9};
  dither.indices(exact, 1, 2, indices.data());
  EXPECT_EQ(indices, (std::array<std::uint8_t, 3>{2, 9, 1}));
}

} // namespace
} // namespace offstage::test
