#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <vector>

namespace offstage::test {

/// What differs between two RGBA pictures of the same size, in units of 1/255; alpha is compared too.
struct ImageDifference {
  int worst = 0; ///< largest difference of a channel
  int worstX = 0, worstY = 0, worstChannel = 0;
  int actual = 0, expected = 0; ///< of that channel
  double psnr = 0.0;            ///< dB over red, green and blue of all compared pixels; infinite when equal
  std::size_t differing = 0;    ///< pixels with any difference
  std::size_t compared = 0;     ///< pixels
};

/// Compares width×height pixels, 4 bytes each, but for those that `skip` (if given) is true for.
ImageDifference compareImages(const std::vector<std::uint8_t>& actual,
                              const std::vector<std::uint8_t>& expected, int width, int height,
                              const std::function<bool(int x, int y)>& skip = {});

/// "worst 26/255 at (12, 34) red: 200, expected 226; PSNR 47.1 dB; 123 of 307200 pixels differ"
std::ostream& operator<<(std::ostream& out, const ImageDifference& difference);

} // namespace offstage::test
