#pragma once

#include "render/raster/frame.h"

#include <cstddef>
#include <cstdint>

namespace offstage {

/// A picture of 8 bits in YUV 4:2:0, chroma sited left and between rows, as H.264 has it.
struct Yuv420 {
  int width = 0;
  int height = 0;
  const std::uint8_t* y = nullptr;
  const std::uint8_t* u = nullptr;
  const std::uint8_t* v = nullptr;
  std::ptrdiff_t yStride = 0; ///< bytes
  std::ptrdiff_t uStride = 0;
  std::ptrdiff_t vStride = 0;
  bool fullRange = false;     ///< Y 0 … 255; otherwise 16 … 235
  bool highDefinition = true; ///< by the matrix of ITU-R BT.709; otherwise BT.601
};

/// As RGBA: chroma interpolated linearly, rounded to 8 bits. `frame` takes the picture's size and keeps its
/// memory where it fits.
void toRgba(const Yuv420& picture, Frame& frame);

} // namespace offstage
