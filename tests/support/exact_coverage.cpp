#include "tests/support/exact_coverage.h"

#include <algorithm>
#include <cmath>

namespace offstage::test {

double exactDiscCoverage(double x, double y, double centerX, double centerY, double radius) {
  double u =
      std::abs(x + 0.5 - centerX); // of the pixel's centre from the circle's, by symmetry in one quadrant
  double v = std::abs(y + 0.5 - centerY);
  if (u > v) std::swap(u, v); // columns along u, where the edge slopes by at most about 1
  const double low = std::max(u - 0.5, -radius);
  const double high = std::min(u + 0.5, radius);
  if (low >= high) return 0.0;
  constexpr int kColumns = 512;
  const double step = (high - low) / kColumns;
  double area = 0.0;
  for (int i = 0; i < kColumns; ++i) {
    const double at = low + (i + 0.5) * step;
    const double edge = std::sqrt((radius - at) * (radius + at));
    area += step * std::max(0.0, std::min(edge, v + 0.5) - std::max(-edge, v - 0.5));
  }
  return area;
}

} // namespace offstage::test
