// Inverse trigonometric functions: fdlibm's s_atan.c, e_atan2.c, e_asin.c, e_acos.c.
#include "src/sim/strict_bits.h"
#include "src/sim/strict_math.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace offstage::strict {
namespace {

constexpr double kPi = 3.1415926535897931160e+00;
constexpr double kPiTail = 1.2246467991473531772e-16;
constexpr double kHalfPi = 1.57079632679489655800e+00;
constexpr double kHalfPiTail = 6.12323399573676603587e-17;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
/// Makes exact-looking results inexact as fdlibm has them; its value is below half an ulp of what it is added
/// to.
constexpr double kTiny = 1.0e-300;

/// (asin(x) − x)/x³·x², a rational approximation on [0, 0.25] of t = x² (or of (1 − x)/2).
double asinRatio(double t) {
  constexpr double p0 = 1.66666666666666657415e-01;
  constexpr double p1 = -3.25565818622400915405e-01;
  constexpr double p2 = 2.01212532134862925881e-01;
  constexpr double p3 = -4.00555345006794114027e-02;
  constexpr double p4 = 7.91534994289814532176e-04;
  constexpr double p5 = 3.47933107596021167570e-05;
  constexpr double q1 = -2.40339491173441421878e+00;
  constexpr double q2 = 2.02094576023350569471e+00;
  constexpr double q3 = -6.88283971605453293030e-01;
  constexpr double q4 = 7.70381505559019352791e-02;
  const double p = t * (p0 + t * (p1 + t * (p2 + t * (p3 + t * (p4 + t * p5)))));
  const double q = 1.0 + t * (q1 + t * (q2 + t * (q3 + t * q4)));
  return p / q;
}

} // namespace

double atan(double x) {
  // atan(0.5), atan(1), atan(1.5), atan(∞): argument intervals are brought to |x| < 7/16 around these.
  constexpr std::array<double, 4> high{4.63647609000806093515e-01, 7.85398163397448278999e-01,
                                       9.82793723247329054082e-01, 1.57079632679489655800e+00};
  constexpr std::array<double, 4> low{2.26987774529616870924e-17, 3.06161699786838301793e-17,
                                      1.39033110312309984516e-17, 6.12323399573676603587e-17};
  constexpr std::array<double, 11> a{
      3.33333333333329318027e-01,  -1.99999999998764832476e-01, 1.42857142725034663711e-01,
      -1.11111104054623557880e-01, 9.09088713343650656196e-02,  -7.69187620504482999495e-02,
      6.66107313738753120669e-02,  -5.83357013379057348645e-02, 4.97687799461593236017e-02,
      -3.65315727442169155270e-02, 1.62858201153657823623e-02};
  const std::int32_t word = magnitudeWord(x);
  const bool negative = highWord(x) < 0;
  if (word >= 0x44100000) { // 2^66
    if (std::isnan(x)) return x + x;
    return negative ? -high[3] - low[3] : high[3] + low[3];
  }
  const bool direct = word < 0x3fdc0000; // 7/16
  std::size_t interval = 0;
  if (direct) {
    if (word < 0x3e200000) return x; // 2^-29
  } else {
    x = std::abs(x);
    if (word < 0x3fe60000) { // 11/16
      interval = 0;
      x = (2.0 * x - 1.0) / (2.0 + x);
    } else if (word < 0x3ff30000) { // 19/16
      interval = 1;
      x = (x - 1.0) / (x + 1.0);
    } else if (word < 0x40038000) { // 39/16
      interval = 2;
      x = (x - 1.5) / (1.0 + 1.5 * x);
    } else {
      interval = 3;
      x = -1.0 / x;
    }
  }
  const double z = x * x;
  const double w = z * z;
  const double odd = z * (a[0] + w * (a[2] + w * (a[4] + w * (a[6] + w * (a[8] + w * a[10])))));
  const double even = w * (a[1] + w * (a[3] + w * (a[5] + w * (a[7] + w * a[9]))));
  if (direct) return x - x * (odd + even);
  const double result = high[interval] - ((x * (odd + even) - low[interval]) - x);
  return negative ? -result : result;
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return x + y;
  if (x == 1.0) return atan(y);
  const bool left = std::signbit(x);
  const bool below = std::signbit(y);
  if (y == 0.0) {
    if (!left) return y;
    return below ? -kPi - kTiny : kPi + kTiny;
  }
  if (x == 0.0) return below ? -kHalfPi - kTiny : kHalfPi + kTiny;
  if (std::isinf(x)) {
    double magnitude = left ? kPi : 0.0;
    if (std::isinf(y)) magnitude = left ? 3.0 * (kHalfPi * 0.5) : kHalfPi * 0.5;
    return below ? -magnitude : magnitude;
  }
  if (std::isinf(y)) return below ? -kHalfPi - kTiny : kHalfPi + kTiny;

  const int exponents = (magnitudeWord(y) - magnitudeWord(x)) >> 20; // of y/x, about
  double z = 0.0;                                                    // atan(|y/x|)
  if (exponents > 60) {
    z = kHalfPi + 0.5 * kPiTail;
  } else if (!(left && exponents < -60)) {
    z = atan(std::abs(y / x));
  }
  if (!left) return below ? -z : z;
  return below ? (z - kPiTail) - kPi : kPi - (z - kPiTail);
}

double asin(double x) {
  const std::int32_t word = magnitudeWord(x);
  const double magnitude = std::abs(x);
  if (magnitude == 1.0) return x * kHalfPi + x * kHalfPiTail;
  if (!(magnitude < 1.0)) return kNan;
  if (word < 0x3fe00000) {           // 0.5
    if (word < 0x3e400000) return x; // 2^-27
    return x + x * asinRatio(x * x);
  }
  const double t = (1.0 - magnitude) * 0.5; // asin(x) = π/2 − 2·asin(√((1 − x)/2))
  const double ratio = asinRatio(t);
  const double s = std::sqrt(t);
  double result = 0.0;
  if (word >= 0x3fef3333) { // 0.975
    result = kHalfPi - (2.0 * (s + s * ratio) - kHalfPiTail);
  } else {
    const double head = withoutLowWord(s);
    const double tail = (t - head * head) / (s + head);
    const double p = 2.0 * s * ratio - (kHalfPiTail - 2.0 * tail);
    const double q = kHalfPi * 0.5 - 2.0 * head;
    result = kHalfPi * 0.5 - (p - q);
  }
  return x > 0.0 ? result : -result;
}

double acos(double x) {
  const std::int32_t word = magnitudeWord(x);
  const double magnitude = std::abs(x);
  if (magnitude == 1.0) return x > 0.0 ? 0.0 : kPi + 2.0 * kHalfPiTail;
  if (!(magnitude < 1.0)) return kNan;
  if (word < 0x3fe00000) {                                // 0.5
    if (word <= 0x3c600000) return kHalfPi + kHalfPiTail; // 2^-57
    return kHalfPi - (x - (kHalfPiTail - x * asinRatio(x * x)));
  }
  if (x < 0.0) {
    const double z = (1.0 + x) * 0.5;
    const double s = std::sqrt(z);
    const double w = asinRatio(z) * s - kHalfPiTail;
    return kPi - 2.0 * (s + w);
  }
  const double z = (1.0 - x) * 0.5;
  const double s = std::sqrt(z);
  const double head = withoutLowWord(s);
  const double tail = (z - head * head) / (s + head);
  const double w = asinRatio(z) * s + tail;
  return 2.0 * (head + w);
}

} // namespace offstage::strict
