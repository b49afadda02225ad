#include "render/compare/flip_filters.h"

#include "render/compare/vector_clones.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace offstage {
namespace {

// Floats, and every sum in the reference tool's order: near white its roundings show in the fifth digit of an
// error, and equal figures should be equal.

constexpr float kPi = std::numbers::pi_v<float>;
/// Of a screen 0.7 m wide with 3840 px, seen from 0.7 m.
constexpr float kPixelsPerDegree = 0.7F * (3840.0F / 0.7F) * (kPi / 180.0F);

constexpr float kColorExponent = 0.7F;  // qc
constexpr float kColorCut = 0.4F;       // pc: the share of the largest distance …
constexpr float kColorCutValue = 0.95F; // pt: … that becomes this error
constexpr float kFeatureWidth = 0.082F; // w, degrees
constexpr int kFeatureReach = 9;        // px: three standard deviations, rounded up
constexpr std::size_t kTaps = 2 * kFlipReach + 1;

// sRGB's primaries and white point (D65) in XYZ, as exact fractions, and the inverse.
struct Matrix {
  float xr, xg, xb, yr, yg, yb, zr, zg, zb;
};
constexpr Matrix kToXyz{10135552.0F / 24577794.0F, 8788810.0F / 24577794.0F, 4435075.0F / 24577794.0F,
                        2613072.0F / 12288897.0F,  8788810.0F / 12288897.0F, 887015.0F / 12288897.0F,
                        1425312.0F / 73733382.0F,  8788810.0F / 73733382.0F, 70074185.0F / 73733382.0F};
constexpr Matrix kFromXyz{3.241003275F, -1.537398934F, -0.498615861F, -0.969224334F, 1.875930071F,
                          0.041554224F, 0.055639423F,  -0.204011202F, 1.057148933F};
constexpr float kWhiteX = 0.950428545F;
constexpr float kWhiteZ = 1.088900371F;
constexpr float kOverWhiteX = 1.052156925F;
constexpr float kOverWhiteZ = 0.918357670F;

/// Where CIELAB's cube root gives way to a line.
constexpr float kDelta = 6.0F / 29.0F;

using Taps = std::array<float, kTaps>;

/// The filters, normalised to a sum of 1 (derivatives: their positive and their negative part).
struct Filters {
  Taps y{}, cx{}, cz1{}, cz2{};   ///< contrast sensitivity; that of Cz is a sum of two Gaussians
  Taps gauss{}, slope{}, curve{}; ///< of the feature detectors: a Gaussian and its derivatives

  Filters() {
    contrastSensitivity();
    features();
  }

private:
  static float gaussian(float x2, float a, float b) {
    return a * std::sqrt(kPi / b) * std::exp(-kPi * kPi * x2 / b);
  }

  void contrastSensitivity() {
    float sumY = 0.0F;
    float sumCx = 0.0F;
    float sumCz1 = 0.0F;
    float sumCz2 = 0.0F;
    for (std::size_t i = 0; i < kTaps; ++i) {
      const float x = (static_cast<float>(i) - kFlipReach) * (1.0F / kPixelsPerDegree);
      sumY += y[i] = gaussian(x * x, 1.0F, 0.0047F);
      sumCx += cx[i] = gaussian(x * x, 1.0F, 0.0053F);
      // A two-dimensional Gaussian's amplitude, halved between the two directions.
      sumCz1 += cz1[i] = std::sqrt(34.1F * std::sqrt(kPi / 0.04F)) * std::exp(-kPi * kPi * x * x / 0.04F);
      sumCz2 += cz2[i] = std::sqrt(13.5F * std::sqrt(kPi / 0.025F)) * std::exp(-kPi * kPi * x * x / 0.025F);
    }
    const float sumCz = std::sqrt(sumCz1 * sumCz1 + sumCz2 * sumCz2);
    for (std::size_t i = 0; i < kTaps; ++i) {
      y[i] *= 1.0F / sumY;
      cx[i] *= 1.0F / sumCx;
      cz1[i] *= 1.0F / sumCz;
      cz2[i] *= 1.0F / sumCz;
    }
  }

  void features() {
    constexpr float kDeviation = 0.5F * kFeatureWidth * kPixelsPerDegree;
    float sum = 0.0F;
    float slopeUp = 0.0F;
    float slopeDown = 0.0F;
    float curveUp = 0.0F;
    float curveDown = 0.0F;
    for (int offset = -kFeatureReach; offset <= kFeatureReach; ++offset) {
      const std::size_t i = static_cast<std::size_t>(kFlipReach) + static_cast<std::size_t>(offset);
      const auto x = static_cast<float>(offset);
      const float g = std::exp(-x * x / (2.0F * kDeviation * kDeviation));
      gauss[i] = g;
      slope[i] = -x * g;
      curve[i] = (x * x / (kDeviation * kDeviation) - 1.0F) * g;
      sum += g;
      (slope[i] > 0.0F ? slopeUp : slopeDown) += std::abs(slope[i]);
      (curve[i] > 0.0F ? curveUp : curveDown) += std::abs(curve[i]);
    }
    for (std::size_t i = 0; i < kTaps; ++i) {
      gauss[i] /= sum;
      slope[i] /= slope[i] > 0.0F ? slopeUp : slopeDown;
      curve[i] /= curve[i] > 0.0F ? curveUp : curveDown;
    }
  }
};

const Filters& filters() {
  static const Filters all;
  return all;
}

/// Pixels whose sums stay in registers.
constexpr std::size_t kLanes = 16;
using Lanes = std::array<float, kLanes>;

/// out[x] = Σ taps[i]·in[x + i·step], for x in 0 … kTileWidth − 1.
[[gnu::always_inline]] inline void convolve(const Taps& taps, int reach, const float* in, std::size_t step,
                                            float* out) {
  const auto first = static_cast<std::size_t>(kFlipReach) - static_cast<std::size_t>(reach);
  const auto last = static_cast<std::size_t>(kFlipReach) + static_cast<std::size_t>(reach);
  for (std::size_t x = 0; x < kTileWidth; x += kLanes) {
    Lanes sum{};
    for (std::size_t i = first; i <= last; ++i) {
      const float weight = taps[i];
      const float* from = in + x + i * step;
      for (std::size_t lane = 0; lane < kLanes; ++lane) sum[lane] += weight * from[lane];
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) out[x + lane] = sum[lane];
  }
}

OFFSTAGE_VECTOR_CLONES
void filterAlongX(const FlipPlanes& planes, int rows, FlipScratch& out) {
  const Filters& f = filters();
  std::array<float, kFlipStride> lightness{};
  for (std::size_t row = 0; row < static_cast<std::size_t>(rows) + 2 * kFlipReach; ++row) {
    const std::size_t in = row * kFlipStride;
    const std::size_t to = row * kTileWidth;
    convolve(f.y, kFlipReach, &planes.y[in], 1, &out.y[to]);
    convolve(f.cx, kFlipReach, &planes.cx[in], 1, &out.cx[to]);
    convolve(f.cz1, kFlipReach, &planes.cz[in], 1, &out.cz1[to]);
    convolve(f.cz2, kFlipReach, &planes.cz[in], 1, &out.cz2[to]);
    // The feature detectors look at Y scaled to 0 … 1.
    for (std::size_t x = 0; x < kFlipStride; ++x)
      lightness[x] = planes.y[in + x] * (1.0F / 116.0F) + 16.0F / 116.0F;
    convolve(f.gauss, kFeatureReach, lightness.data(), 1, &out.gauss[to]);
    convolve(f.slope, kFeatureReach, lightness.data(), 1, &out.slope[to]);
    convolve(f.curve, kFeatureReach, lightness.data(), 1, &out.curve[to]);
  }
}

float labCurve(float t) {
  if (t > kDelta * kDelta * kDelta) return std::pow(t, 1.0F / 3.0F);
  return t * (1.0F / (3.0F * kDelta * kDelta)) + 4.0F / 29.0F;
}

float clamped(float x) {
  return std::min(std::max(x, 0.0F), 1.0F);
}

/// Linear RGB to L*, a*, b*, the latter two less the darker a colour is (Hunt).
[[gnu::always_inline]] inline void toHuntLab(float r, float g, float b, float& lightness, float& red,
                                             float& blue) {
  const float x = labCurve((kToXyz.xr * r + kToXyz.xg * g + kToXyz.xb * b) * kOverWhiteX);
  const float y = labCurve(kToXyz.yr * r + kToXyz.yg * g + kToXyz.yb * b);
  const float z = labCurve((kToXyz.zr * r + kToXyz.zg * g + kToXyz.zb * b) * kOverWhiteZ);
  lightness = 116.0F * y - 16.0F;
  red = 0.01F * lightness * (500.0F * (x - y));
  blue = 0.01F * lightness * (200.0F * (y - z));
}

OFFSTAGE_VECTOR_CLONES
void filterAlongY(const FlipScratch& in, int rows, FlipResponse& out) {
  using Row = std::array<float, kTileWidth>;
  const Filters& f = filters();
  Row y, cx, cz1, cz2, slopeX, slopeY, curveX, curveY;
  for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
    const std::size_t from = row * kTileWidth;
    convolve(f.y, kFlipReach, &in.y[from], kTileWidth, y.data());
    convolve(f.cx, kFlipReach, &in.cx[from], kTileWidth, cx.data());
    convolve(f.cz1, kFlipReach, &in.cz1[from], kTileWidth, cz1.data());
    convolve(f.cz2, kFlipReach, &in.cz2[from], kTileWidth, cz2.data());
    convolve(f.gauss, kFeatureReach, &in.slope[from], kTileWidth, slopeX.data());
    convolve(f.gauss, kFeatureReach, &in.curve[from], kTileWidth, curveX.data());
    convolve(f.slope, kFeatureReach, &in.gauss[from], kTileWidth, slopeY.data());
    convolve(f.curve, kFeatureReach, &in.gauss[from], kTileWidth, curveY.data());
    for (std::size_t x = 0; x < kTileWidth; ++x) {
      const float white = (y[x] + 16.0F) / 116.0F;
      const float xyzX = (white + cx[x] / 500.0F) * kWhiteX;
      const float xyzZ = (white - (cz1[x] + cz2[x]) / 200.0F) * kWhiteZ;
      const float r = clamped(kFromXyz.xr * xyzX + kFromXyz.xg * white + kFromXyz.xb * xyzZ);
      const float g = clamped(kFromXyz.yr * xyzX + kFromXyz.yg * white + kFromXyz.yb * xyzZ);
      const float b = clamped(kFromXyz.zr * xyzX + kFromXyz.zg * white + kFromXyz.zb * xyzZ);
      toHuntLab(r, g, b, out.lightness[from + x], out.red[from + x], out.blue[from + x]);
      out.edge[from + x] = std::sqrt(slopeX[x] * slopeX[x] + slopeY[x] * slopeY[x]);
      out.point[from + x] = std::sqrt(curveX[x] * curveX[x] + curveY[x] * curveY[x]);
    }
  }
}

/// HyAB distance of two colours in L*a*b*: city block in lightness, Euclid in a* and b*.
float hyab(float lightness, float red, float blue) {
  return std::abs(lightness) + std::sqrt(red * red + blue * blue);
}

/// The largest distance that two colours of sRGB can have: green from blue, raised to qc.
float largestDistance() {
  float greenL = 0.0F;
  float greenA = 0.0F;
  float greenB = 0.0F;
  float blueL = 0.0F;
  float blueA = 0.0F;
  float blueB = 0.0F;
  toHuntLab(0.0F, 1.0F, 0.0F, greenL, greenA, greenB);
  toHuntLab(0.0F, 0.0F, 1.0F, blueL, blueA, blueB);
  return std::pow(hyab(greenL - blueL, greenA - blueA, greenB - blueB), kColorExponent);
}

std::array<float, 256> linearLevels() {
  std::array<float, 256> levels{};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const float c = static_cast<float>(i) / 255.0F;
    levels[i] = c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
  }
  return levels;
}

} // namespace

void toYCxCz(const std::uint8_t* rgb, float& y, float& cx, float& cz) {
  static const std::array<float, 256> linear = linearLevels();
  const float r = linear[rgb[0]];
  const float g = linear[rgb[1]];
  const float b = linear[rgb[2]];
  const float xyzX = (kToXyz.xr * r + kToXyz.xg * g + kToXyz.xb * b) * kOverWhiteX;
  const float xyzY = kToXyz.yr * r + kToXyz.yg * g + kToXyz.yb * b;
  const float xyzZ = (kToXyz.zr * r + kToXyz.zg * g + kToXyz.zb * b) * kOverWhiteZ;
  y = 116.0F * xyzY - 16.0F;
  cx = 500.0F * (xyzX - xyzY);
  cz = 200.0F * (xyzY - xyzZ);
}

void filterTile(const FlipPlanes& planes, int rows, FlipScratch& scratch, FlipResponse& response) {
  filterAlongX(planes, rows, scratch);
  filterAlongY(scratch, rows, response);
}

void flipErrors(const FlipResponse& reference, const FlipResponse& test, int row, int columns,
                float* errors) {
  static const float kLargest = largestDistance();
  static const float kCut = kColorCut * kLargest;
  for (int column = 0; column < columns; ++column) {
    const std::size_t i = static_cast<std::size_t>(row) * kTileWidth + static_cast<std::size_t>(column);
    const float distance = hyab(reference.lightness[i] - test.lightness[i], reference.red[i] - test.red[i],
                                reference.blue[i] - test.blue[i]);
    if (distance == 0.0F) {
      errors[column] = 0.0F;
      continue;
    }
    float color = std::pow(distance, kColorExponent);
    color = color < kCut ? color * (kColorCutValue / kCut)
                         : kColorCutValue + (color - kCut) / (kLargest - kCut) * (1.0F - kColorCutValue);
    const float feature =
        std::max(std::abs(reference.edge[i] - test.edge[i]), std::abs(reference.point[i] - test.point[i]));
    // The exponent qf of the feature difference is 1/2.
    errors[column] = std::pow(color, 1.0F - std::sqrt(feature * (1.0F / std::numbers::sqrt2_v<float>)));
  }
}

} // namespace offstage
