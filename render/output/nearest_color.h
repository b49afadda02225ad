#pragma once

#include "render/output/gif_palette.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace offstage {

/// The eye's weights of the channels' squared differences, roughly.
inline constexpr std::array<int, 3> kEyeWeights{3, 6, 1};

/// Finds a palette's colour that is nearest to a given one: the least sum of weighted squared differences,
/// and the first of several. Space is cut into cubes; the first question in a cube finds which colours can be
/// nearest to any of its points, and from then on only these are looked at.
class NearestColor {
public:
  explicit NearestColor(std::vector<GifColor> palette); ///< 1 to 256 colours

  /// The index of the nearest to red, green and blue from 0 to 255.
  std::uint8_t find(const std::array<int, 3>& color);
  [[nodiscard]] const std::vector<GifColor>& palette() const { return palette_; }

private:
  static constexpr int kSideBits = 3; ///< a cube is 2^3 levels a side
  static constexpr int kCellBits = 8 - kSideBits;
  using Candidates = std::vector<std::uint8_t>;
  static std::size_t cellOf(const std::array<int, 3>& color);
  void fill(Candidates& candidates, const std::array<int, 3>& color) const;

  std::vector<GifColor> palette_;
  std::vector<Candidates> cells_; ///< by the upper bits of red, green and blue; empty: not asked for yet
};

} // namespace offstage
