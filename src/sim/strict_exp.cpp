// Exponentials, logarithms and what is made of them: fdlibm's e_exp.c, s_expm1.c, e_log.c, e_log10.c,
// e_sinh.c, e_cosh.c, s_tanh.c.
#include "src/sim/strict_bits.h"
#include "src/sim/strict_math.h"

#include <cmath>
#include <limits>

namespace offstage::strict {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kLn2High = 6.93147180369123816490e-01; ///< 32 bits, so that k·kLn2High is exact
constexpr double kLn2Low = 1.90821492927058770002e-10;
constexpr double kInverseLn2 = 1.44269504088896338700e+00;
constexpr double kLargestExp = 7.09782712893383973096e+02; ///< above: exp overflows
constexpr std::int32_t kInfinityWord = 0x7ff00000;

/// x = 2^exponent·fraction with √2/2 < fraction < √2, for finite x > 0.
struct Split {
  int exponent;
  double fraction;
};

Split split(double x) {
  int exponent = 0;
  std::int32_t word = highWord(x);
  if (word < 0x00100000) { // subnormal
    exponent = -54;
    x *= 0x1.0p54;
    word = highWord(x);
  }
  exponent += (word >> 20) - 1023;
  word &= 0x000fffff;
  const std::int32_t carry = (word + 0x95f64) & 0x100000; // set when the fraction is above √2
  return {exponent + (carry >> 20), withHighWord(x, word | (carry ^ 0x3ff00000))};
}

} // namespace

double exp(double x) {
  constexpr double smallest = -7.45133219101941108420e+02; // below: exp underflows
  constexpr double p1 = 1.66666666666666019037e-01;
  constexpr double p2 = -2.77777777770155933842e-03;
  constexpr double p3 = 6.61375632143793436117e-05;
  constexpr double p4 = -1.65339022054652515390e-06;
  constexpr double p5 = 4.13813679705723846039e-08;
  if (std::isnan(x)) return x + x;
  if (x > kLargestExp) return kInfinity;
  if (x < smallest) return 0.0;

  // x = k·ln 2 + (high − low), |high − low| ≤ ln(2)/2.
  const std::int32_t word = magnitudeWord(x);
  double high = 0.0;
  double low = 0.0;
  int k = 0;
  if (word > 0x3fd62e42) {   // ln(2)/2
    if (word < 0x3ff0a2b2) { // 3·ln(2)/2
      k = x < 0.0 ? -1 : 1;
    } else {
      k = static_cast<int>(kInverseLn2 * x + (x < 0.0 ? -0.5 : 0.5));
    }
    high = x - k * kLn2High;
    low = k * kLn2Low;
    x = high - low;
  } else if (word < 0x3e300000) { // 2^-28
    return 1.0 + x;
  }
  const double t = x * x;
  const double c = x - t * (p1 + t * (p2 + t * (p3 + t * (p4 + t * p5))));
  if (k == 0) return 1.0 - ((x * c) / (c - 2.0) - x);
  const double y = 1.0 - ((low - (x * c) / (2.0 - c)) - high);
  if (k >= -1021) return addToExponent(y, k);
  return addToExponent(y, k + 1000) * 0x1.0p-1000; // a subnormal result rounds once, here
}

double expm1(double x) {
  constexpr double q1 = -3.33333333333331316428e-02;
  constexpr double q2 = 1.58730158725481460165e-03;
  constexpr double q3 = -7.93650757867487942473e-05;
  constexpr double q4 = 4.00821782732936239552e-06;
  constexpr double q5 = -2.01099218183624371326e-07;
  if (std::isnan(x)) return x + x;
  const std::int32_t word = magnitudeWord(x);
  const bool negative = std::signbit(x);
  if (word >= 0x4043687a) { // 56·ln 2
    if (x > kLargestExp) return kInfinity;
    if (negative) return 1.0e-300 - 1.0;
  }
  double low = 0.0;
  double correction = 0.0; // rounding error of the reduced argument
  int k = 0;
  if (word > 0x3fd62e42) {   // ln(2)/2
    if (word < 0x3ff0a2b2) { // 3·ln(2)/2
      k = negative ? -1 : 1;
    } else {
      k = static_cast<int>(kInverseLn2 * x + (negative ? -0.5 : 0.5));
    }
    const double high = x - k * kLn2High;
    low = k * kLn2Low;
    x = high - low;
    correction = (high - x) - low;
  } else if (word < 0x3c900000) { // 2^-54
    return x;
  }
  const double halfX = 0.5 * x;
  const double halfSquare = x * halfX;
  const double r1 =
      1.0 + halfSquare * (q1 + halfSquare * (q2 + halfSquare * (q3 + halfSquare * (q4 + halfSquare * q5))));
  double t = 3.0 - r1 * halfX;
  double e = halfSquare * ((r1 - t) / (6.0 - x * t));
  if (k == 0) return x - (x * e - halfSquare);
  e = x * (e - correction) - correction;
  e -= halfSquare;
  if (k == -1) return 0.5 * (x - e) - 0.5;
  if (k == 1) return x < -0.25 ? -2.0 * (e - (x + 0.5)) : 1.0 + 2.0 * (x - e);
  if (k <= -2 || k > 56) return addToExponent(1.0 - (e - x), k) - 1.0;
  if (k < 20) {
    t = fromWords(0x3ff00000 - (0x200000 >> k), 0); // 1 − 2^-k
    return addToExponent(t - (e - x), k);
  }
  t = fromWords((0x3ff - k) << 20, 0); // 2^-k
  return addToExponent((x - (e + t)) + 1.0, k);
}

double log(double x) {
  constexpr double g1 = 6.666666666666735130e-01;
  constexpr double g2 = 3.999999999940941908e-01;
  constexpr double g3 = 2.857142874366239149e-01;
  constexpr double g4 = 2.222219843214978396e-01;
  constexpr double g5 = 1.818357216161805012e-01;
  constexpr double g6 = 1.531383769920937332e-01;
  constexpr double g7 = 1.479819860511658591e-01;
  if (x == 0.0) return -kInfinity;
  if (x < 0.0) return kNan;
  if (magnitudeWord(x) >= kInfinityWord) return x + x;

  const auto [exponent, fraction] = split(x);
  const double k = exponent;
  const double f = fraction - 1.0;
  const std::int32_t word = highWord(x < 0x1.0p-1022 ? x * 0x1.0p54 : x) & 0x000fffff;
  if ((0x000fffff & (2 + word)) < 3) { // |f| < 2^-20
    if (f == 0.0) return exponent == 0 ? 0.0 : k * kLn2High + k * kLn2Low;
    const double r = f * f * (0.5 - 0.33333333333333333 * f);
    return exponent == 0 ? f - r : k * kLn2High - ((r - k * kLn2Low) - f);
  }
  const double s = f / (2.0 + f);
  const double z = s * s;
  const double w = z * z;
  const double even = w * (g2 + w * (g4 + w * g6));
  const double odd = z * (g1 + w * (g3 + w * (g5 + w * g7)));
  const double r = odd + even;
  if (((word - 0x6147a) | (0x6b851 - word)) > 0) { // fraction in the middle: f²/2 is taken out for accuracy
    const double halfSquare = 0.5 * f * f;
    return exponent == 0 ? f - (halfSquare - s * (halfSquare + r))
                         : k * kLn2High - ((halfSquare - (s * (halfSquare + r) + k * kLn2Low)) - f);
  }
  return exponent == 0 ? f - s * (f - r) : k * kLn2High - ((s * (f - r) - k * kLn2Low) - f);
}

double log10(double x) {
  constexpr double inverseLn10 = 4.34294481903251816668e-01;
  constexpr double log2High = 3.01029995663611771306e-01; // of log10(2)
  constexpr double log2Low = 3.69423907715893078616e-13;
  if (x == 0.0) return -kInfinity;
  if (x < 0.0) return kNan;
  if (magnitudeWord(x) >= kInfinityWord) return x + x;
  int k = 0;
  if (x < 0x1.0p-1022) {
    k = -54;
    x *= 0x1.0p54;
  }
  k += (highWord(x) >> 20) - 1023;
  const int below = k < 0 ? 1 : 0; // for negative exponents the fraction is taken from [0.5, 1)
  x = withHighWord(x, (highWord(x) & 0x000fffff) | ((0x3ff - below) << 20));
  const double y = k + below;
  const double z = y * log2Low + inverseLn10 * log(x);
  return z + y * log2High;
}

double log2(double x) {
  if (!(x > 0.0) || std::isinf(x)) return log(x);
  const auto [exponent, fraction] = split(x);
  return exponent + log(fraction) * kInverseLn2;
}

double sinh(double x) {
  if (!std::isfinite(x)) return x + x;
  const std::int32_t word = magnitudeWord(x);
  const double magnitude = std::abs(x);
  const double half = x < 0.0 ? -0.5 : 0.5;
  if (word < 0x40360000) {           // 22
    if (word < 0x3e300000) return x; // 2^-28
    const double t = expm1(magnitude);
    if (word < 0x3ff00000) return half * (2.0 * t - t * t / (t + 1.0));
    return half * (t + t / (t + 1.0));
  }
  if (word < 0x40862e42) return half * exp(magnitude); // ln(largest double)
  const double root = exp(0.5 * magnitude); // up to where sinh itself overflows, exp(x) would before it
  return half * root * root;
}

double cosh(double x) {
  if (!std::isfinite(x)) return x * x;
  const std::int32_t word = magnitudeWord(x);
  const double magnitude = std::abs(x);
  if (word < 0x3fd62e43) { // ln(2)/2
    const double t = expm1(magnitude);
    const double w = 1.0 + t;
    return word < 0x3c800000 ? w : 1.0 + (t * t) / (w + w); // 2^-55
  }
  if (word < 0x40360000) { // 22
    const double t = exp(magnitude);
    return 0.5 * t + 0.5 / t;
  }
  if (word < 0x40862e42) return 0.5 * exp(magnitude); // ln(largest double)
  const double root = exp(0.5 * magnitude);
  return 0.5 * root * root;
}

double tanh(double x) {
  if (std::isnan(x)) return x + x;
  const std::int32_t word = magnitudeWord(x);
  const double magnitude = std::abs(x);
  double z = 1.0; // from 22 on, and at infinity
  if (word < 0x40360000) {
    if (word < 0x3c800000) return x * (1.0 + x); // 2^-55
    if (word >= 0x3ff00000) {
      z = 1.0 - 2.0 / (expm1(2.0 * magnitude) + 2.0);
    } else {
      const double t = expm1(-2.0 * magnitude);
      z = -t / (t + 2.0);
    }
  }
  return std::signbit(x) ? -z : z;
}

} // namespace offstage::strict
