#include "render/compare/yuv_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// One sample of a plane, its edges repeated.
double sampleOf(const std::vector<std::uint8_t>& plane, int width, int height, int x, int y) {
  return plane[static_cast<std::size_t>(std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1))];
}

/// Linear interpolation at (x, y) of the plane's own samples.
double between(const std::vector<std::uint8_t>& plane, int width, int height, double x, double y) {
  const int left = static_cast<int>(std::floor(x));
  const int top = static_cast<int>(std::floor(y));
  const auto row = [&](int at) {
    return sampleOf(plane, width, height, left, at) * (1.0 - (x - left)) +
           sampleOf(plane, width, height, left + 1, at) * (x - left);
  };
  return row(top) * (1.0 - (y - top)) + row(top + 1) * (y - top);
}

TEST(YuvRows, AreWhatTheStandardsFormulasGive) {
  for (const bool highDefinition : {false, true}) {
    for (const bool fullRange : {false, true}) {
      for (const auto& [width, height] : {std::pair(16, 12), std::pair(7, 5), std::pair(1, 1)}) {
        const int chromaWidth = (width + 1) / 2;
        const int chromaHeight = (height + 1) / 2;
        std::uint32_t state = 5;
        const auto plane = [&state](int size) {
          std::vector<std::uint8_t> values;
          for (int i = 0; i < size; ++i) {
            state = state * 1664525U + 1013904223U;
            values.push_back(static_cast<std::uint8_t>(state >> 24U));
          }
          return values;
        };
        const std::vector<std::uint8_t> y = plane(width * height);
        const std::vector<std::uint8_t> u = plane(chromaWidth * chromaHeight);
        const std::vector<std::uint8_t> v = plane(chromaWidth * chromaHeight);
        Frame frame;
        toRgba({width, height, y.data(), u.data(), v.data(), width, chromaWidth, chromaWidth, fullRange,
                highDefinition},
               frame);
        const double kr = highDefinition ? 0.2126 : 0.299;
        const double kb = highDefinition ? 0.0722 : 0.114;
        for (int row = 0; row < height; ++row) {
          for (int column = 0; column < width; ++column) {
            const double luma = sampleOf(y, width, height, column, row);
            const double chromaY = (row - 0.5) / 2.0;
            const double cb = between(u, chromaWidth, chromaHeight, column / 2.0, chromaY) - 128.0;
            const double cr = between(v, chromaWidth, chromaHeight, column / 2.0, chromaY) - 128.0;
            const double light = fullRange ? luma : (luma - 16.0) * 255.0 / 219.0;
            const double scale = fullRange ? 1.0 : 255.0 / 224.0;
            const double red = light + 2.0 * (1.0 - kr) * cr * scale;
            const double blue = light + 2.0 * (1.0 - kb) * cb * scale;
            const double green = (light - kr * red - kb * blue) / (1.0 - kr - kb);
            const std::array<double, 4> wanted{red, green, blue, 255.0};
            for (std::size_t c = 0; c < 4; ++c) {
              const auto at = 4 * static_cast<std::size_t>(row * width + column) + c;
              ASSERT_NEAR(frame.rgba[at], std::clamp(wanted.at(c), 0.0, 255.0), 0.51)
                  << fmt::format("{}x{} at {}, {} channel {}", width, height, column, row, c);
            }
          }
        }
      }
    }
  }
}

} // namespace
} // namespace offstage::test
