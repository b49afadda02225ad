#include "render/output/nearest_color.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace offstage {
namespace {

int squared(int value) {
  return value * value;
}

} // namespace

NearestColor::NearestColor(std::vector<GifColor> palette)
    : palette_(std::move(palette)), cells_(std::size_t{1} << (3 * kCellBits)) {}

std::size_t NearestColor::cellOf(const std::array<int, 3>& color) {
  std::size_t cell = 0;
  for (const int level : color) cell = cell << kCellBits | static_cast<std::size_t>(level >> kSideBits);
  return cell;
}

void NearestColor::fill(Candidates& candidates, const std::array<int, 3>& color) const {
  // A colour farther from the cube's nearest point than another is from its farthest is nearest to none of
  // them.
  std::array<int, 256> least{};
  int bound = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < palette_.size(); ++i) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const int level = palette_[i][c];
      const int low = color[c] >> kSideBits << kSideBits;
      const int high = low + (1 << kSideBits) - 1;
      least[i] += kEyeWeights[c] * squared(std::max({low - level, level - high, 0}));
      most += kEyeWeights[c] * squared(std::max(high - level, level - low));
    }
    bound = std::min(bound, most);
  }
  for (std::size_t i = 0; i < palette_.size(); ++i)
    if (least[i] <= bound) candidates.push_back(static_cast<std::uint8_t>(i));
}

std::uint8_t NearestColor::find(const std::array<int, 3>& color) {
  Candidates& candidates = cells_[cellOf(color)];
  if (candidates.empty()) fill(candidates, color);
  int best = std::numeric_limits<int>::max();
  std::uint8_t index = 0;
  for (const std::uint8_t candidate : candidates) {
    int distance = 0;
    for (std::size_t c = 0; c < 3; ++c)
      distance += kEyeWeights[c] * squared(color[c] - palette_[candidate][c]);
    if (distance >= best) continue;
    best = distance;
    index = candidate;
  }
  return index;
}

} // namespace offstage
