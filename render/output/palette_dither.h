#pragma once

#include "render/output/color_table.h"
#include "render/output/gif_palette.h"
#include "render/output/nearest_color.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// Finds a palette's index for a pixel by position: ordered dithering between the palette's own colours (the
/// idea of T. Knoll's pattern dithering, US patent 6606166, expired). The result depends on the colour and
/// the place only, so what stands still in the clip stands still in the picture, and a colour of the palette
/// is itself.
class PaletteDither {
public:
  explicit PaletteDither(std::vector<GifColor> palette);

  /// The indices of a row's pixels, the first of which is at (x, y). Where a pixel is wholly transparent, its
  /// index stays as it is.
  void indices(std::span<const std::uint8_t> rgba, int x, int y, std::uint8_t* indices);

private:
  static constexpr int kSide = 4; ///< px of the pattern
  using Plan = std::array<std::uint8_t, kSide * kSide>;
  Plan plan(const GifColor& color);
  const Plan& planOf(std::uint32_t key);

  NearestColor nearest_;
  std::array<int, 256> brightness_{}; ///< of the palette's colours
  ColorTable<Plan> plans_;
};

} // namespace offstage
