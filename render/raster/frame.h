#pragma once

#include "render/draw/picture.h"

#include <cstdint>
#include <vector>

namespace offstage {

/// A drawn frame: RGBA8, rows top-down without padding, sRGB, alpha not premultiplied (255 everywhere when
/// the picture's background is opaque).
struct Frame {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba; ///< width*height*4

  /// Which drawing this is, unique in the process; 0: not drawn by a canvas, or changed since.
  std::uint64_t id = 0;
  /// The drawing that `damage` refers to; 0: every pixel counts as changed. Whoever keeps something made from
  /// an earlier frame (converted colours, compressed rows) may keep it only if that frame's id was `base`.
  std::uint64_t base = 0;
  /// px, disjoint: outside of them every pixel equals that of the drawing `base`. Without meaning when base
  /// is 0.
  std::vector<PixelRect> damage{};

  /// XXH3-64 of the size (two little-endian int32) and the pixels: the pixel hash of `--hash`.
  [[nodiscard]] std::uint64_t hash() const;
};

} // namespace offstage
