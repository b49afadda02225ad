#include "render/raster/area_reduce.h"

#include <algorithm>
#include <cmath>

namespace offstage {
namespace {

/// The source cells that one cell of the result covers along an axis, and how much of each.
struct Span {
  double low;  ///< source cells
  double high; ///< source cells
  int first;
  int last; ///< inclusive

  Span(int index, int source, int result)
      : low(static_cast<double>(index) * source / result),
        high(static_cast<double>(index + 1) * source / result),
        first(static_cast<int>(low)),
        last(std::min(static_cast<int>(std::ceil(high)), source) - 1) {}

  [[nodiscard]] double share(int cell) const {
    return std::min(high, cell + 1.0) - std::max(low, static_cast<double>(cell));
  }
};

} // namespace

std::vector<std::uint8_t> areaReduce(const Image& image, int width, int height) {
  const auto sourceWidth = static_cast<std::size_t>(image.width);
  std::vector<std::uint8_t> result(4UL * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::vector<double> row(4UL * sourceWidth); // one row of the result, not yet reduced in width
  std::uint8_t* out = result.data();
  for (int y = 0; y < height; ++y) {
    std::fill(row.begin(), row.end(), 0.0);
    const Span rows(y, image.height, height);
    for (int sourceY = rows.first; sourceY <= rows.last; ++sourceY) {
      const double share = rows.share(sourceY);
      const std::uint8_t* in = image.rgba.data() + 4UL * sourceWidth * static_cast<std::size_t>(sourceY);
      for (std::size_t i = 0; i < row.size(); i += 4) {
        const double alpha = share * in[i + 3];
        row[i] += alpha * in[i];
        row[i + 1] += alpha * in[i + 1];
        row[i + 2] += alpha * in[i + 2];
        row[i + 3] += alpha * 255.0;
      }
    }
    for (int x = 0; x < width; ++x) {
      const Span columns(x, image.width, width);
      const double area = (columns.high - columns.low) * (rows.high - rows.low);
      for (std::size_t channel = 0; channel < 4; ++channel) {
        double sum = 0.0;
        for (int sourceX = columns.first; sourceX <= columns.last; ++sourceX) {
          sum += columns.share(sourceX) * row[4UL * static_cast<std::size_t>(sourceX) + channel];
        }
        *out++ = static_cast<std::uint8_t>(std::min(sum / (area * 255.0) + 0.5, 255.0));
      }
    }
  }
  return result;
}

} // namespace offstage
