#include "render/raster/image_detail.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace offstage {
namespace {

/// Sums of the channels over blocks of texels, those at the right and bottom edge smaller.
struct Blocks {
  struct Block {
    std::array<double, 4> sum{};
    double texels = 0.0;
  };
  std::size_t width;
  std::size_t height;
  std::vector<Block> blocks;
};

Blocks texelsOf(const Image& image) {
  Blocks level{static_cast<std::size_t>(image.width), static_cast<std::size_t>(image.height), {}};
  level.blocks.resize(level.width * level.height);
  for (std::size_t i = 0; i < level.blocks.size(); ++i) {
    const std::uint8_t* texel = image.rgba.data() + 4 * i;
    const double alpha = texel[3] / 255.0;
    level.blocks[i] = {{texel[0] * alpha, texel[1] * alpha, texel[2] * alpha, 1.0 * texel[3]}, 1.0};
  }
  return level;
}

Blocks doubled(const Blocks& level) {
  Blocks larger{(level.width + 1) / 2, (level.height + 1) / 2, {}};
  larger.blocks.resize(larger.width * larger.height);
  for (std::size_t y = 0; y < level.height; ++y) {
    for (std::size_t x = 0; x < level.width; ++x) {
      const Blocks::Block& part = level.blocks[y * level.width + x];
      Blocks::Block& whole = larger.blocks[y / 2 * larger.width + x / 2];
      for (std::size_t c = 0; c < part.sum.size(); ++c) whole.sum[c] += part.sum[c];
      whole.texels += part.texels;
    }
  }
  return larger;
}

/// The mean over all texels and channels of the square of their block's mean.
double meanSquare(const Blocks& level) {
  double sum = 0.0;
  double texels = 0.0;
  for (const Blocks::Block& block : level.blocks) {
    for (const double channel : block.sum) sum += channel * channel / block.texels;
    texels += block.texels;
  }
  return sum / (4.0 * texels);
}

} // namespace

std::vector<double> imageDetail(const Image& image) {
  Blocks level = texelsOf(image);
  const double all = meanSquare(level);
  std::vector<double> detail{0.0};
  while (level.width > 1 || level.height > 1) {
    level = doubled(level);
    // Block means leave of the mean square what does not vary inside blocks.
    detail.push_back(std::sqrt(std::max(all - meanSquare(level), 0.0)));
  }
  return detail;
}

} // namespace offstage
