#include "render/output/rgb_pack.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace offstage {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes packed(const Bytes& rgba, std::size_t pixels, bool wide) {
  Bytes rgb(3 * pixels + 64, 0xEE); // what lies behind belongs to somebody else
  packRgb(rgba.data(), rgb.data(), pixels, wide);
  return rgb;
}

TEST(RgbPack, DropsEveryFourthByteAtAnyLengthAndWidthAndLeavesWhatFollows) {
  for (std::size_t pixels = 0; pixels <= 70; ++pixels) {
    Bytes rgba(4 * pixels); // exactly: a sanitizer sees what is read behind them
    for (std::size_t i = 0; i < rgba.size(); ++i) rgba[i] = static_cast<std::uint8_t>(7 * i + 1);
    Bytes expected(3 * pixels + 64, 0xEE);
    for (std::size_t x = 0; x < pixels; ++x) {
      for (std::size_t c = 0; c < 3; ++c) expected[3 * x + c] = rgba[4 * x + c];
    }
    EXPECT_EQ(packed(rgba, pixels, false), expected) << pixels << " pixels";
    if (!processorIsWide()) continue;
    EXPECT_EQ(packed(rgba, pixels, true), expected) << pixels << " pixels, wide";
  }
}

} // namespace
} // namespace offstage
