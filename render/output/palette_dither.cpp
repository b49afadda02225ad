#include "render/output/palette_dither.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace offstage {
namespace {

constexpr std::size_t kMostPlans = 1U << 19U;

/// Bayer's matrix of order 4: neighbours differ as much as they can.
constexpr std::array<std::uint8_t, 16> kThresholds{0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};

} // namespace

PaletteDither::PaletteDither(std::vector<GifColor> palette) : nearest_(std::move(palette)) {
  for (std::size_t i = 0; i < nearest_.palette().size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) brightness_[i] += nearest_.palette()[i][c] * kEyeWeights[c];
}

PaletteDither::Plan PaletteDither::plan(const GifColor& color) {
  // Colours whose mean comes close to the wanted one: each makes good for what those before it have missed.
  // By brightness, and of equals the first.
  Plan plan{};
  std::array<int, 3> missed{};
  for (std::size_t count = 0; count < plan.size(); ++count) {
    std::array<int, 3> wanted{};
    for (std::size_t c = 0; c < 3; ++c) wanted[c] = std::clamp(color[c] + missed[c], 0, 255);
    const std::uint8_t found = nearest_.find(wanted);
    for (std::size_t c = 0; c < 3; ++c) missed[c] += color[c] - nearest_.palette()[found][c];
    std::size_t at = count;
    for (; at > 0 && brightness_[plan[at - 1]] > brightness_[found]; --at) plan[at] = plan[at - 1];
    plan[at] = found;
  }
  return plan;
}

const PaletteDither::Plan& PaletteDither::planOf(std::uint32_t key) {
  if (const Plan* const known = plans_.find(key)) return *known;
  if (plans_.size() >= kMostPlans) plans_.clear();
  return plans_[key] = plan(colorOfKey(key));
}

void PaletteDither::indices(std::span<const std::uint8_t> rgba, int x, int y, std::uint8_t* indices) {
  const std::uint8_t* const thresholds = &kThresholds[static_cast<std::size_t>(y % kSide) * kSide];
  const Plan* plan = nullptr;
  std::uint32_t planned = 0;
  for (std::size_t at = 0; at < rgba.size(); at += 4, ++x, ++indices) {
    if (rgba[at + 3] == 0) continue;
    const std::uint32_t key = keyOfColor(&rgba[at]);
    if (plan == nullptr || key != planned) {
      plan = &planOf(key);
      planned = key;
    }
    *indices = (*plan)[thresholds[x % kSide]];
  }
}

} // namespace offstage
