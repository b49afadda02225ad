#include "render/compare/compare_images.h"
#include "render/compare/difference_pass.h"
#include "render/compare/frame_rows.h"
#include "render/output/frame_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace offstage {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

constexpr Rgb kForgiven{255, 214, 0};
constexpr Rgb kOnlyExpected{120, 170, 255};
constexpr Rgb kOnlyActual{255, 170, 90};
constexpr Rgb kUncovered{128, 128, 128};
/// From the smallest difference to the largest.
constexpr std::array<Rgb, 3> kRamp{{{124, 58, 237}, {236, 38, 143}, {255, 0, 0}}};

std::uint8_t mixed(double from, double to, double share) {
  return static_cast<std::uint8_t>(std::lround(from + (to - from) * share));
}

/// The colour of a difference of so many levels. Small ones are told apart by the square root.
Rgb rampColor(double levels) {
  const double at = std::sqrt(std::clamp(levels / 255.0, 0.0, 1.0)) * (kRamp.size() - 1);
  const auto index = std::min(static_cast<std::size_t>(at), kRamp.size() - 2);
  Rgb color{};
  for (std::size_t c = 0; c < 3; ++c)
    color.at(c) = mixed(kRamp.at(index).at(c), kRamp.at(index + 1).at(c), at - static_cast<double>(index));
  return color;
}

void put(Frame& frame, int x, int y, const Rgb& color) {
  std::uint8_t* to = &frame.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                                      static_cast<std::size_t>(x))];
  std::copy(color.begin(), color.end(), to);
  to[3] = 255;
}

/// Grey, and near to white: what does not differ steps back.
Rgb paled(const std::uint8_t* rgba) {
  const double luma = 0.299 * rgba[0] + 0.587 * rgba[1] + 0.114 * rgba[2];
  const double overWhite = 255.0 + (luma - 255.0) * rgba[3] / 255.0;
  const std::uint8_t grey = mixed(255.0, overWhite, 0.25);
  return {grey, grey, grey};
}

Frame emptyFrame(int width, int height, const Rgb& color) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  frame.rgba.resize(4UL * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < frame.rgba.size(); i += 4) {
    std::copy(color.begin(), color.end(), &frame.rgba[i]);
    frame.rgba[i + 3] = 255;
  }
  return frame;
}

/// Largest difference of a channel, what alpha 0 hides left out unless strict.
int pixelDifference(const std::uint8_t* a, const std::uint8_t* b, bool strictAlpha) {
  int largest = std::abs(a[3] - b[3]);
  if (!strictAlpha && (a[3] == 0 || b[3] == 0)) return largest;
  for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
  return largest;
}

/// Copies a frame over a white ground.
void paste(Frame& onto, const Frame& frame, int left) {
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const std::uint8_t* from =
          &frame.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                           static_cast<std::size_t>(x))];
      Rgb color{};
      for (std::size_t c = 0; c < 3; ++c) color.at(c) = mixed(255.0, from[c], from[3] / 255.0);
      put(onto, left + x, y, color);
    }
  }
}

} // namespace

Frame Comparer::difference(const PixelRows& expected, const PixelRows& actual) {
  const int width = std::max(expected.width(), actual.width());
  const int height = std::max(expected.height(), actual.height());
  const bool sameSize = expected.width() == actual.width() && expected.height() == actual.height();
  static const BitPlane kNothing;
  const BitPlane& ignored = sameSize ? ignoredFor(width, height) : kNothing;
  DifferencePass pass;
  if (sameSize)
    pass = findDifferences(expected, actual,
                           {tolerance_.maxChannel.value_or(0.0), tolerance_.strictAlpha,
                            tolerance_.ignoreAntialiasing, &ignored, threads_});

  Frame picture = emptyFrame(width, height, kUncovered);
  std::vector<std::uint8_t> expectedBuffer(4UL * static_cast<std::size_t>(expected.width()));
  std::vector<std::uint8_t> actualBuffer(4UL * static_cast<std::size_t>(actual.width()));
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* a = y < expected.height() ? expected.row8(y, expectedBuffer.data()) : nullptr;
    const std::uint8_t* b = y < actual.height() ? actual.row8(y, actualBuffer.data()) : nullptr;
    const int both = std::min(a != nullptr ? expected.width() : 0, b != nullptr ? actual.width() : 0);
    for (int x = 0; x < width; ++x) {
      if (x >= both) {
        if (a != nullptr && x < expected.width()) put(picture, x, y, kOnlyExpected);
        if (b != nullptr && x < actual.width()) put(picture, x, y, kOnlyActual);
        continue;
      }
      const std::uint8_t* pixelA = a + 4 * static_cast<std::size_t>(x);
      const std::uint8_t* pixelB = b + 4 * static_cast<std::size_t>(x);
      const int levels = pixelDifference(pixelA, pixelB, tolerance_.strictAlpha);
      const bool differs = sameSize ? pass.differing.get(x, y) : levels > 0;
      if (differs)
        put(picture, x, y, rampColor(levels));
      else if (pass.forgiven.get(x, y))
        put(picture, x, y, kForgiven);
      else if (ignored.get(x, y) && (x + y) % 6 < 2)
        put(picture, x, y, {190, 190, 190});
      else
        put(picture, x, y, paled(pixelA));
    }
  }
  return picture;
}

Frame Comparer::difference(const Frame& expected, const Frame& actual) {
  requireWholeFrame(expected);
  requireWholeFrame(actual);
  return difference(FrameRows(expected), FrameRows(actual));
}

Frame makeStrip(const Frame& expected, const Frame& difference, const Frame& actual) {
  constexpr int kMargin = 8; // px between the three
  Frame strip = emptyFrame(expected.width + difference.width + actual.width + 2 * kMargin,
                           std::max({expected.height, difference.height, actual.height}), kUncovered);
  paste(strip, expected, 0);
  paste(strip, difference, expected.width + kMargin);
  paste(strip, actual, expected.width + difference.width + 2 * kMargin);
  return strip;
}

} // namespace offstage
