#include "render/output/repeat_mask.h"

#include <cstddef>
#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace offstage {
namespace {

constexpr std::size_t kBytes = 4;

/// Pixels of two colours, and of a third that differs from the first in alpha alone.
std::vector<std::uint8_t> somePixels(std::mt19937& random, std::size_t count) {
  std::vector<std::uint8_t> pixels(count * kBytes, 255);
  for (std::size_t i = 0; i < count; ++i) {
    if (random() % 16 == 0) pixels[i * kBytes + random() % kBytes] = 0;
  }
  return pixels;
}

bool same(const std::uint8_t* a, const std::uint8_t* b, bool alpha) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2] && (!alpha || a[3] == b[3]);
}

void expectHolds(const RepeatMask& mask, const std::vector<bool>& expected, std::string_view what) {
  const std::size_t pixels = expected.size();
  for (std::size_t at = 0; at <= pixels; ++at) {
    std::size_t run = 0;
    while (at + run < pixels && expected[at + run]) ++run;
    ASSERT_EQ(mask.run(at), run) << what << " at " << at << " of " << pixels << " pixels";
  }
  std::vector<bool> visited(pixels);
  std::size_t last = 0;
  mask.forEach([&](std::size_t pixel) {
    ASSERT_LT(pixel, pixels) << what;
    ASSERT_GE(pixel, last) << what;
    last = pixel;
    visited[pixel] = true;
  });
  ASSERT_EQ(visited, expected) << what << " of " << pixels << " pixels";
}

/// Held to a comparison pixel by pixel.
void expectMasks(bool wide) {
  std::mt19937 random(7); // NOLINT(bugprone-random-generator-seed): the same in every run
  for (const bool alpha : {false, true}) {
    for (const std::size_t pixels : {1U, 2U, 7U, 63U, 64U, 65U, 127U, 128U, 129U, 200U, 1000U}) {
      const std::vector<std::uint8_t> upper = somePixels(random, pixels);
      const std::vector<std::uint8_t> row = somePixels(random, pixels);
      std::vector<bool> isBefore(pixels);
      std::vector<bool> isAbove(pixels);
      std::vector<bool> isLiteral(pixels);
      for (std::size_t i = 0; i < pixels; ++i) {
        const std::uint8_t* const pixel = &row[i * kBytes];
        isBefore[i] = i > 0 && same(pixel, pixel - kBytes, alpha);
        isAbove[i] = same(pixel, &upper[i * kBytes], alpha);
      }
      for (std::size_t i = 0; i < pixels; ++i)
        isLiteral[i] = !isBefore[i] && !(isAbove[i] && i + 1 < pixels && isAbove[i + 1]);

      RepeatMask before(pixels, alpha, wide);
      RepeatMask above(pixels, alpha, wide);
      RepeatMask literals(pixels, alpha, wide);
      before.compareWithPrevious(row.data());
      above.compare(row.data(), upper.data());
      literals.setLiterals(before, above);
      expectHolds(before, isBefore, "before");
      expectHolds(above, isAbove, "above");
      expectHolds(literals, isLiteral, "literals");

      literals.set(pixels - 1, !isLiteral[pixels - 1]);
      isLiteral[pixels - 1] = !isLiteral[pixels - 1];
      expectHolds(literals, isLiteral, "literals with the last one changed");
      above.clear();
      expectHolds(above, std::vector<bool>(pixels), "nothing");
    }
  }
}

TEST(RepeatMask, FindsEveryRunAtAnyWidth) {
  expectMasks(false);
  if (processorIsWide()) expectMasks(true);
}

} // namespace
} // namespace offstage
