#pragma once

#include "render/raster/frame.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace offstage {

/// Where the three planes of a YUV 4:2:0 picture go. Luma is width × height rounded up to even, chroma half
/// of that each way.
struct Yuv420Planes {
  std::uint8_t* y = nullptr;
  std::uint8_t* u = nullptr;  ///< Cb
  std::uint8_t* v = nullptr;  ///< Cr
  std::ptrdiff_t yStride = 0; ///< bytes from row to row
  std::ptrdiff_t uStride = 0;
  std::ptrdiff_t vStride = 0;
};

/// The next even number: 4:2:0 has no odd sizes.
constexpr int evenSize(int size) {
  return size + size % 2;
}

/// Converts RGBA8 to 8-bit YUV 4:2:0 in limited range, alpha left out, by ITU-R BT.709-6, section 3 (signal
/// format). With R, G and B from 0 to 1:
///   E'Y = 0.2126 R + 0.7152 G + 0.0722 B
///   E'CB = (B − E'Y)/1.8556, E'CR = (R − E'Y)/1.5748
///   Y = round(219 E'Y + 16), Cb = round(224 E'CB + 128), Cr = round(224 E'CR + 128)
/// in integers, so that every machine and compiler gives the same bytes. Each byte is within 0.506 of the
/// value before rounding (measured over all 2^24 colours; 0.14 % of them differ from the exactly rounded
/// value, by 1). Greys have Cb = Cr = 128 exactly, white is 235, black 16.
///
/// Chroma is sited left (AVCHROMA_LOC_LEFT, the default of H.264: on the even columns, between two rows):
/// weights 1 2 1 over the columns 2i − 1, 2i, 2i + 1, and the mean of rows 2j and 2j + 1. Outside the picture
/// the nearest column counts. An odd width or height is padded by repeating the last column or row.
class Yuv420Converter {
public:
  /// Of a frame whose `base` is the frame that was converted before, only what is damaged: the planes must
  /// still hold that one.
  void convert(const Frame& frame, const Yuv420Planes& planes);

private:
  /// The pixels, from even to even, whose conversion depends on the damaged ones.
  static PixelRect affected(const Frame& frame, const PixelRect& damage);
  void convert(const Frame& frame, const Yuv420Planes& planes, const PixelRect& rect);

  std::uint64_t converted_ = 0; ///< id of the frame that the planes hold; 0: none that can be told
  /// Sums of two rows of one channel, with a column more at either end.
  std::vector<std::uint16_t> red_;
  std::vector<std::uint16_t> green_;
  std::vector<std::uint16_t> blue_;
};

} // namespace offstage
