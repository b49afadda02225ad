// Sine, cosine, tangent: fdlibm's s_sin.c, s_cos.c, s_tan.c and their kernels k_sin.c, k_cos.c, k_tan.c,
// which approximate on |x| ≤ π/4 by the minimax polynomials that are given there.
#include "src/sim/strict_bits.h"
#include "src/sim/strict_math.h"
#include "src/sim/strict_reduction.h"

#include <array>
#include <cmath>

namespace offstage::strict {
namespace {

constexpr std::int32_t kQuarterPiWord = 0x3fe921fb; ///< high word of π/4
constexpr std::int32_t kInfinityWord = 0x7ff00000;

/// sin(x + tail) for |x| ≤ π/4: x + S1·x³ + … + S6·x¹³.
double kernelSin(double x, double tail, bool hasTail) {
  constexpr double s1 = -1.66666666666666324348e-01;
  constexpr double s2 = 8.33333333332248946124e-03;
  constexpr double s3 = -1.98412698298579493134e-04;
  constexpr double s4 = 2.75573137070700676789e-06;
  constexpr double s5 = -2.50507602534068634195e-08;
  constexpr double s6 = 1.58969099521155010221e-10;
  if (magnitudeWord(x) < 0x3e400000) return x; // below 2^-27 the cubic term is less than half an ulp
  const double z = x * x;
  const double cube = z * x;
  const double r = s2 + z * (s3 + z * (s4 + z * (s5 + z * s6)));
  if (!hasTail) return x + cube * (s1 + z * r);
  return x - ((z * (0.5 * tail - cube * r) - tail) - cube * s1);
}

/// cos(x + tail) for |x| ≤ π/4: 1 − x²/2 + C1·x⁴ + … + C6·x¹⁴, with part of x²/2 taken off the 1 first where
/// it is large, so that this subtraction is exact.
double kernelCos(double x, double tail) {
  constexpr double c1 = 4.16666666666666019037e-02;
  constexpr double c2 = -1.38888888888741095749e-03;
  constexpr double c3 = 2.48015872894767294178e-05;
  constexpr double c4 = -2.75573143513906633035e-07;
  constexpr double c5 = 2.08757232129817482790e-09;
  constexpr double c6 = -1.13596475577881948265e-11;
  const std::int32_t word = magnitudeWord(x);
  if (word < 0x3e400000) return 1.0; // 2^-27
  const double z = x * x;
  const double r = z * (c1 + z * (c2 + z * (c3 + z * (c4 + z * (c5 + z * c6)))));
  if (word < 0x3fd33333) return 1.0 - (0.5 * z - (z * r - x * tail));                // 0.3
  const double part = word > 0x3fe90000 ? 0.28125 : fromWords(word - 0x00200000, 0); // 0.78125; else x/4
  const double half = 0.5 * z - part;
  const double rest = 1.0 - part;
  return rest - (half - (z * r - x * tail));
}

/// −1/(x + rest) with the rounding error of the quotient put right; sum = x + rest rounded.
double negativeReciprocal(double sum, double x, double rest) {
  const double head = withoutLowWord(sum);
  const double tail = rest - (head - x);
  const double quotient = -1.0 / sum;
  const double quotientHead = withoutLowWord(quotient);
  const double error = 1.0 + quotientHead * head;
  return quotientHead + quotient * (error + quotientHead * tail);
}

/// tan(x + tail) for |x| ≤ π/4, or −1/tan when `reciprocal`. Above 0.67434 by
/// tan(π/4 − u) = 1 − 2·tan(u)/(1 + tan(u)).
double kernelTan(double x, double tail, bool reciprocal) {
  constexpr std::array<double, 13> t{
      3.33333333333334091986e-01, 1.33333333333201242699e-01, 5.39682539762260521377e-02,
      2.18694882948595424599e-02, 8.86323982359930005737e-03, 3.59207910759131235356e-03,
      1.45620945432529025516e-03, 5.88041240820264096874e-04, 2.46463134818469906812e-04,
      7.81794442939557092300e-05, 7.14072491382608190305e-05, -1.85586374855275456654e-05,
      2.59073051863633712884e-05};
  constexpr double quarterPi = 7.85398163397448278999e-01;
  constexpr double quarterPiTail = 3.06161699786838301793e-17;
  const bool negative = highWord(x) < 0;
  const std::int32_t word = magnitudeWord(x);
  if (word < 0x3e300000) { // 2^-28
    return reciprocal ? negativeReciprocal(x + tail, x, tail) : x;
  }
  const bool nearQuarter = word >= 0x3fe59428; // 0.6744
  if (nearQuarter) {
    if (negative) {
      x = -x;
      tail = -tail;
    }
    x = (quarterPi - x) + (quarterPiTail - tail);
    tail = 0.0;
  }
  const double z = x * x;
  const double w = z * z;
  // The even and the odd terms apart, so that the two sums can be computed side by side.
  double r = t[1] + w * (t[3] + w * (t[5] + w * (t[7] + w * (t[9] + w * t[11]))));
  const double v = z * (t[2] + w * (t[4] + w * (t[6] + w * (t[8] + w * (t[10] + w * t[12])))));
  const double cube = z * x;
  r = tail + z * (cube * (r + v) + tail);
  r += t[0] * cube;
  const double sum = x + r;
  if (nearQuarter) {
    const double sign = negative ? -1.0 : 1.0;
    const double one = reciprocal ? -1.0 : 1.0;
    return sign * (one - 2.0 * (x - (sum * sum / (sum + one) - r)));
  }
  return reciprocal ? negativeReciprocal(sum, x, r) : sum;
}

} // namespace

double sin(double x) {
  const std::int32_t word = magnitudeWord(x);
  if (word <= kQuarterPiWord) return kernelSin(x, 0.0, false);
  if (word >= kInfinityWord) return x - x; // NaN
  const ReducedAngle angle = reduceAngle(x);
  switch (angle.quadrant & 3) {
  case 0:
    return kernelSin(angle.high, angle.low, true);
  case 1:
    return kernelCos(angle.high, angle.low);
  case 2:
    return -kernelSin(angle.high, angle.low, true);
  default:
    return -kernelCos(angle.high, angle.low);
  }
}

double cos(double x) {
  const std::int32_t word = magnitudeWord(x);
  if (word <= kQuarterPiWord) return kernelCos(x, 0.0);
  if (word >= kInfinityWord) return x - x; // NaN
  const ReducedAngle angle = reduceAngle(x);
  switch (angle.quadrant & 3) {
  case 0:
    return kernelCos(angle.high, angle.low);
  case 1:
    return -kernelSin(angle.high, angle.low, true);
  case 2:
    return -kernelCos(angle.high, angle.low);
  default:
    return kernelSin(angle.high, angle.low, true);
  }
}

double tan(double x) {
  const std::int32_t word = magnitudeWord(x);
  if (word <= kQuarterPiWord) return kernelTan(x, 0.0, false);
  if (word >= kInfinityWord) return x - x; // NaN
  const ReducedAngle angle = reduceAngle(x);
  return kernelTan(angle.high, angle.low, (angle.quadrant & 1) != 0);
}

} // namespace offstage::strict
