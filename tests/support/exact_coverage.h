#pragma once

namespace offstage::test {

/// The area of the pixel [x, x + 1] × [y, y + 1] that lies in the circle, in doubles: 512 columns (or rows,
/// where the edge is steep) with exact height. Error below 1e-4.
double exactDiscCoverage(double x, double y, double centerX, double centerY, double radius);

} // namespace offstage::test
