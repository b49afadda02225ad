#pragma once

#include <cstdint>
#include <vector>

namespace offstage {

/// A drawn frame: RGBA8, rows top-down without padding, sRGB, alpha not premultiplied (255 everywhere when
/// the picture's background is opaque).
struct Frame {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba; ///< width*height*4

  /// XXH3-64 of the size (two little-endian int32) and the pixels: the pixel hash of `--hash`.
  [[nodiscard]] std::uint64_t hash() const;
};

} // namespace offstage
