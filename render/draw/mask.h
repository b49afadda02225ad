#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace offstage {

/// How much of each pixel something covers: 0 (nothing) … 255 (all), rows top-down. Glyphs and formulas.
struct Mask {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> coverage; ///< width*height

  [[nodiscard]] bool empty() const { return width <= 0 || height <= 0; }
};

} // namespace offstage
