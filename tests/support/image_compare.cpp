#include "tests/support/image_compare.h"

#include <array>
#include <cmath>
#include <limits>
#include <ostream>

namespace offstage::test {

ImageDifference compareImages(const std::vector<std::uint8_t>& actual,
                              const std::vector<std::uint8_t>& expected, int width, int height,
                              const std::function<bool(int x, int y)>& skip) {
  ImageDifference result;
  double squares = 0.0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (skip && skip(x, y)) continue;
      ++result.compared;
      const std::size_t pixel =
          4UL * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
      bool differs = false;
      for (int channel = 0; channel < 4; ++channel) {
        const int a = actual.at(pixel + static_cast<std::size_t>(channel));
        const int b = expected.at(pixel + static_cast<std::size_t>(channel));
        const int difference = std::abs(a - b);
        differs = differs || difference != 0;
        if (channel < 3) squares += static_cast<double>(difference) * difference;
        if (difference > result.worst) {
          result.worst = difference;
          result.worstX = x;
          result.worstY = y;
          result.worstChannel = channel;
          result.actual = a;
          result.expected = b;
        }
      }
      if (differs) ++result.differing;
    }
  }
  const double mean = squares / (3.0 * static_cast<double>(result.compared));
  result.psnr =
      squares > 0.0 ? 10.0 * std::log10(255.0 * 255.0 / mean) : std::numeric_limits<double>::infinity();
  return result;
}

std::ostream& operator<<(std::ostream& out, const ImageDifference& difference) {
  constexpr std::array<const char*, 4> kChannels{"red", "green", "blue", "alpha"};
  return out << "worst " << difference.worst << "/255 at (" << difference.worstX << ", " << difference.worstY
             << ") " << kChannels.at(static_cast<std::size_t>(difference.worstChannel)) << ": "
             << difference.actual << ", expected " << difference.expected << "; PSNR " << difference.psnr
             << " dB; " << difference.differing << " of " << difference.compared << " pixels differ";
}

} // namespace offstage::test
