// Powers: fdlibm's e_pow.c. log2(x) is computed to some 70 bits as a sum of two doubles, multiplied by y
// without loss, and 2 is raised to the product.
#include "src/sim/strict_bits.h"
#include "src/sim/strict_math.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace offstage::strict {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

enum class Parity { NotInteger, Odd, Even };

Parity parityOf(double y) {
  const double magnitude = std::abs(y);
  if (magnitude >= 0x1.0p53) return Parity::Even;
  if (std::floor(magnitude) != magnitude) return Parity::NotInteger;
  return std::fmod(magnitude, 2.0) == 1.0 ? Parity::Odd : Parity::Even; // fmod is exact
}

/// A number as head + tail; the head has at most 21 significant bits in its fraction.
struct Pair {
  double head;
  double tail;
};

/// log2(1 + t) for |t| ≤ 2^-20, by four terms of the series (for exponents beyond 2^31).
Pair log2NearOne(double t) {
  constexpr double inverseLn2 = 1.44269504088896338700e+00;
  constexpr double inverseLn2High = 1.44269502162933349609e+00; // 24 bits
  constexpr double inverseLn2Low = 1.92596299112661746887e-08;
  const double w = (t * t) * (0.5 - t * (0.3333333333333333333333 - t * 0.25));
  const double u = inverseLn2High * t;
  const double v = t * inverseLn2Low - w * inverseLn2;
  const double head = withoutLowWord(u + v);
  return {head, v - (head - u)};
}

/// log2(x) for finite x > 0.
Pair log2Pair(double x) {
  // 1 and 1.5, the points around which the fraction is expanded, and their log2 in two parts.
  constexpr std::array<double, 2> point{1.0, 1.5};
  constexpr std::array<double, 2> logHigh{0.0, 5.84962487220764160156e-01};
  constexpr std::array<double, 2> logLow{0.0, 1.35003920212974897128e-08};
  // (3/2)·(log(x) − 2s − (2/3)·s³) = s⁵·(l1 + …), s = (x − point)/(x + point).
  constexpr double l1 = 5.99999999999994648725e-01;
  constexpr double l2 = 4.28571428578550184252e-01;
  constexpr double l3 = 3.33333329818377432918e-01;
  constexpr double l4 = 2.72728123808534006489e-01;
  constexpr double l5 = 2.30660745775561754067e-01;
  constexpr double l6 = 2.06975017800338417784e-01;
  constexpr double factor = 9.61796693925975554329e-01; // 2/(3·ln 2)
  constexpr double factorHigh = 9.61796700954437255859e-01;
  constexpr double factorLow = -7.02846165095275826516e-09;

  int n = 0;
  if (magnitudeWord(x) < 0x00100000) { // subnormal
    x *= 0x1.0p53;
    n -= 53;
  }
  std::int32_t word = magnitudeWord(x);
  n += (word >> 20) - 0x3ff;
  const std::int32_t fraction = word & 0x000fffff;
  word = fraction | 0x3ff00000;
  std::size_t k = 0;
  if (fraction <= 0x3988e) { // below √(3/2)
    k = 0;
  } else if (fraction < 0xbb67a) { // below √3
    k = 1;
  } else {
    k = 0;
    n += 1;
    word -= 0x00100000;
  }
  x = withHighWord(x, word);

  const double u = x - point[k];
  const double v = 1.0 / (x + point[k]);
  const double s = u * v;
  const double sHead = withoutLowWord(s);
  double sumHead = fromWords(((word >> 1) | 0x20000000) + 0x00080000 + static_cast<std::int32_t>(k << 18),
                             0); // of x + point
  double sumTail = x - (sumHead - point[k]);
  const double sTail = v * ((u - sHead * sumHead) - sHead * sumTail);
  double square = s * s;
  double r =
      square * square * (l1 + square * (l2 + square * (l3 + square * (l4 + square * (l5 + square * l6)))));
  r += sTail * (sHead + s);
  square = sHead * sHead;
  sumHead = withoutLowWord(3.0 + square + r);
  sumTail = r - ((sumHead - 3.0) - square);
  const double product = sHead * sumHead;
  const double productTail = sTail * sumHead + sumTail * s;
  const double pHead = withoutLowWord(product + productTail);
  const double pTail = productTail - (pHead - product);
  const double zHead = factorHigh * pHead;
  const double zTail = factorLow * pHead + pTail * factor + logLow[k];
  const double t = n;
  const double head = withoutLowWord(((zHead + zTail) + logHigh[k]) + t);
  return {head, zTail - (((head - t) - logHigh[k]) - zHead)};
}

/// sign·2^(head + tail), head + tail = z rounded.
double exp2Pair(double z, double head, double tail, double sign) {
  constexpr double p1 = 1.66666666666666019037e-01;
  constexpr double p2 = -2.77777777770155933842e-03;
  constexpr double p3 = 6.61375632143793436117e-05;
  constexpr double p4 = -1.65339022054652515390e-06;
  constexpr double p5 = 4.13813679705723846039e-08;
  constexpr double ln2 = 6.93147180559945286227e-01;
  constexpr double ln2High = 6.93147182464599609375e-01;
  constexpr double ln2Low = -1.90465429995776804525e-09;
  constexpr double overflowTail = 8.0085662595372944372e-17; // −(1024 − log2(largest double + half an ulp))
  const std::int32_t word = highWord(z);
  const std::int32_t magnitude = word & 0x7fffffff;
  if (word >= 0x40900000) { // z ≥ 1024
    if (z > 1024.0 || tail + overflowTail > z - head) return sign * kInfinity;
  } else if (magnitude >= 0x4090cc00) { // z ≤ −1075
    if (z < -1075.0 || (z == -1075.0 && tail <= z - head)) return sign * 0.0;
  }
  int n = 0;
  if (magnitude > 0x3fe00000) { // |z| > 0.5: n = z rounded to an integer
    int exponent = (magnitude >> 20) - 0x3ff;
    const std::int32_t rounded = word + (0x00100000 >> (exponent + 1));
    exponent = ((rounded & 0x7fffffff) >> 20) - 0x3ff;
    const double whole = fromWords(rounded & ~(0x000fffff >> exponent), 0);
    n = ((rounded & 0x000fffff) | 0x00100000) >> (20 - exponent);
    if (word < 0) n = -n;
    head -= whole;
  }
  const double t = withoutLowWord(tail + head);
  const double u = t * ln2High;
  const double v = (tail - (t - head)) * ln2 + t * ln2Low;
  double result = u + v;
  const double w = v - (result - u);
  const double square = result * result;
  const double c = result - square * (p1 + square * (p2 + square * (p3 + square * (p4 + square * p5))));
  const double r = (result * c) / (c - 2.0) - (w + result * w);
  result = 1.0 - (r - result);
  const std::int32_t scaled = static_cast<std::int32_t>(static_cast<std::uint32_t>(highWord(result)) +
                                                        (static_cast<std::uint32_t>(n) << 20));
  if ((scaled >> 20) <= 0)
    return sign * std::ldexp(result, n); // subnormal: ldexp rounds once, by IEEE 754's rule
  return sign * withHighWord(result, scaled);
}

} // namespace

double pow(double x, double y) {
  if (y == 0.0) return 1.0;
  if (std::isnan(x) || std::isnan(y)) return x + y;
  const double magnitude = std::abs(x);
  if (std::isinf(y)) {
    if (magnitude == 1.0) return kNan; // as Java has it; C gives 1
    return (magnitude > 1.0) == (y > 0.0) ? kInfinity : 0.0;
  }
  if (y == 1.0) return x;
  if (y == 2.0) return x * x;
  if (y == 0.5 && x >= -std::numeric_limits<double>::max()) return std::sqrt(x + 0.0);
  if (y == -1.0) return 1.0 / x;

  const Parity parity = x < 0.0 || std::signbit(x) ? parityOf(y) : Parity::NotInteger;
  const double sign = std::signbit(x) && parity == Parity::Odd ? -1.0 : 1.0;
  if (x == 0.0 || std::isinf(x)) return sign * ((x == 0.0) == (y > 0.0) ? 0.0 : kInfinity);
  if (magnitude == 1.0) return std::signbit(x) && parity == Parity::NotInteger ? kNan : sign;
  if (x < 0.0 && parity == Parity::NotInteger) return kNan;

  Pair log{};
  if (std::abs(y) > 0x1.00000ffffffffp31) { // beyond, only bases next to 1 do not over- or underflow
    const std::int32_t word = magnitudeWord(magnitude);
    if (word < 0x3fefffff) return y < 0.0 ? sign * kInfinity : sign * 0.0;
    if (word > 0x3ff00000) return y > 0.0 ? sign * kInfinity : sign * 0.0;
    log = log2NearOne(magnitude - 1.0);
  } else {
    log = log2Pair(magnitude);
  }
  const double yHead = withoutLowWord(y);
  const double tail = (y - yHead) * log.head + y * log.tail;
  const double head = yHead * log.head;
  return exp2Pair(tail + head, head, tail, sign);
}

} // namespace offstage::strict
