#include "src/sim/strict_reduction.h"

#include "src/sim/strict_bits.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace offstage::strict {
namespace {

// π/2 in pieces of 33 bits, each with the tail that follows it (fdlibm, e_rem_pio2.c). A multiple n·piece is
// exact for the n < 2^20 that the medium range needs.
constexpr double kPio2First = 1.57079632673412561417e+00;
constexpr double kPio2FirstTail = 6.07710050650619224932e-11;
constexpr double kPio2Second = 6.07710050630396597660e-11;
constexpr double kPio2SecondTail = 2.02226624879595063154e-21;
constexpr double kPio2Third = 2.02226624871116645580e-21;
constexpr double kPio2ThirdTail = 8.47842766036889956997e-32;
constexpr double kTwoOverPi = 6.36619772367581382433e-01;
constexpr double kPio2 = 1.57079632679489655800e+00;

ReducedAngle tailed(int quadrant, double remainder, double tail) {
  const double high = remainder - tail;
  return {quadrant, high, (remainder - high) - tail};
}

/// |x| < 3π/4: one subtraction of π/2.
ReducedAngle reduceSmall(double magnitude) {
  double z = magnitude - kPio2First;
  if (highWord(magnitude) != 0x3ff921fb) return tailed(1, z, kPio2FirstTail);
  z -= kPio2Second; // close to π/2 the first 33 bits cancel
  return tailed(1, z, kPio2SecondTail);
}

/// |x| ≤ 2^19·π/2: Cody and Waite's reduction, in as many steps as cancellation asks for.
ReducedAngle reduceMedium(double magnitude) {
  const auto n = static_cast<int>(std::floor(magnitude * kTwoOverPi + 0.5));
  const double factor = n;
  double remainder = magnitude - factor * kPio2First;
  double tail = factor * kPio2FirstTail; // first step: good to 85 bits
  const std::int32_t word = highWord(magnitude);
  // Far from the multiple of π/2 nothing cancels (fdlibm keeps a table of these 31 words).
  if (n < 32 && word != highWord(factor * kPio2)) return tailed(n, remainder, tail);

  const int exponent = word >> 20;
  const auto lostBits = [exponent](const ReducedAngle& angle) {
    return exponent - ((highWord(angle.high) >> 20) & 0x7ff);
  };
  ReducedAngle angle = tailed(n, remainder, tail);
  if (lostBits(angle) <= 16) return angle;

  double before = remainder; // second step: good to 118 bits
  tail = factor * kPio2Second;
  remainder = before - tail;
  tail = factor * kPio2SecondTail - ((before - remainder) - tail);
  angle = tailed(n, remainder, tail);
  if (lostBits(angle) <= 49) return angle;

  before = remainder; // third step: 151 bits, which covers every double of this range
  tail = factor * kPio2Third;
  remainder = before - tail;
  tail = factor * kPio2ThirdTail - ((before - remainder) - tail);
  return tailed(n, remainder, tail);
}

/// 2/π in digits of 24 bits, the first just below the binary point: as many as the largest double asks for.
constexpr std::array<std::uint32_t, 54> kTwoOverPiDigits{
    0xa2f983, 0x6e4e44, 0x1529fc, 0x2757d1, 0xf534dd, 0xc0db62, 0x95993c, 0x439041, 0xfe5163,
    0xabdebb, 0xc561b7, 0x246e3a, 0x424dd2, 0xe00649, 0x2eea09, 0xd1921c, 0xfe1deb, 0x1cb129,
    0xa73ee8, 0x8235f5, 0x2ebb44, 0x84e99c, 0x7026b4, 0x5f7e41, 0x3991d6, 0x398353, 0x39f49c,
    0x845f8b, 0xbdf928, 0x3b1ff8, 0x97ffde, 0x05980f, 0xef2f11, 0x8b5a0a, 0x6d1f6d, 0x367ecf,
    0x27cb09, 0xb74f46, 0x3f669e, 0x5fea2d, 0x7527ba, 0xc7ebe5, 0xf17b3d, 0x0739f7, 0x8a5292,
    0xea6bfb, 0x5fb11f, 0x8d5d08, 0x560330, 0x46fc7b, 0x6babf0, 0xcfbc20, 0x9af436, 0x1da9e3};
/// π/2 in pieces of 24 bits.
constexpr std::array<double, 5> kPio2Pieces{1.57079625129699707031e+00, 7.54978941586159635335e-08,
                                            5.39030252995776476554e-15, 3.28200341580791294123e-22,
                                            1.27065575308067607349e-29};
constexpr int kDigitBits = 24;
constexpr std::uint64_t kDigitMask = (1U << kDigitBits) - 1;
constexpr int kFirstDigits = 5;         ///< of the product, before cancellation is known
constexpr std::size_t kMostDigits = 12; ///< far more than the 61 bits that cancel at worst need
using Digits = std::array<std::uint64_t, kMostDigits>;

/// A number of quarter turns, |x|·2/π, as a whole number modulo 8 and a rest in [−1/2, 1/2).
struct Turns {
  int quadrant;    ///< the whole number
  bool negative;   ///< of the rest
  Digits fraction; ///< the rest's magnitude: digit i has weight 2^(scale − 24·i)
};

/// The `count` leading digits of (x[0] + x[1]·2^-24 + x[2]·2^-48)·2/π from digit `skipped` of 2/π on (those
/// before it give multiples of 8). Digit i of the product has weight 2^(scale − 24·i).
Turns multiplyByTwoOverPi(const std::array<std::uint64_t, 3>& x, int skipped, int scale, int count) {
  Digits digits{};
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int k = skipped + i - j;
      if (k >= 0)
        digits[static_cast<std::size_t>(i)] +=
            x[static_cast<std::size_t>(j)] * kTwoOverPiDigits.at(static_cast<std::size_t>(k));
    }
  }
  for (auto i = static_cast<std::size_t>(count) - 1; i > 0; --i) {
    digits[i - 1] += digits[i] >> kDigitBits;
    digits[i] &= kDigitMask;
  }
  // The binary point lies in digit `top`, above its lowest `bits` bits.
  const std::size_t top = scale < 0 ? 0 : 1;
  const int bits = scale < 0 ? -scale : kDigitBits - scale;
  Turns turns{};
  std::uint64_t whole = digits[top] >> bits;
  if (top == 1) whole += digits[0] << scale;
  digits[0] = top == 1 ? 0 : digits[0];
  digits[top] &= (1ULL << bits) - 1;
  turns.negative = digits[top] >> (bits - 1) != 0; // from 1/2 on the next quadrant is nearer
  if (turns.negative) {
    ++whole;
    std::uint64_t borrow = 0;
    for (auto i = static_cast<std::size_t>(count) - 1; i > top; --i) {
      const std::uint64_t taken = digits[i] + borrow;
      borrow = taken != 0 ? 1 : 0;
      digits[i] = (0 - taken) & kDigitMask;
    }
    digits[top] = (1ULL << bits) - digits[top] - borrow;
  }
  turns.quadrant = static_cast<int>(whole & 7U);
  turns.fraction = digits;
  return turns;
}

/// Larger |x|: Payne and Hanek, "Radian reduction for trigonometric functions" (SIGNUM Newsletter 18, 1983),
/// with the lengths of fdlibm's k_rem_pio2.c (its precision 2), on which the last bits of `low` depend; the
/// multiplication by 2/π is in integers here.
ReducedAngle reduceLarge(double magnitude) {
  // magnitude = (x0 + x1·2^-24 + x2·2^-48)·2^exponent with digits of 24 bits.
  const int exponent = (highWord(magnitude) >> 20) - 1046;
  const std::uint64_t mantissa = (std::bit_cast<std::uint64_t>(magnitude) & 0xfffffffffffffULL) | 1ULL << 52;
  const std::array<std::uint64_t, 3> x{mantissa >> 29, (mantissa >> 5) & kDigitMask,
                                       (mantissa << 19) & kDigitMask};
  const int skipped = exponent < 3 ? 0 : (exponent - 3) / kDigitBits;
  const int scale = exponent - kDigitBits * (skipped + 1);

  // More digits until kFirstDigits of them, counted from the first that is not zero, are there.
  int count = kFirstDigits;
  Turns turns = multiplyByTwoOverPi(x, skipped, scale, count);
  const auto firstDigit = [&turns](int limit) {
    int first = 0;
    while (first < limit && turns.fraction[static_cast<std::size_t>(first)] == 0) ++first;
    return first;
  };
  for (int zeros = firstDigit(count - 1); zeros > count - kFirstDigits; zeros = firstDigit(count - 1)) {
    count = kFirstDigits + zeros;
    turns = multiplyByTwoOverPi(x, skipped, scale, count);
  }

  // The fraction's digits as doubles, most significant first; one that does not fit 24 bits is split.
  std::array<double, kMostDigits + 1> digits{};
  std::size_t length = 0;
  const auto first = static_cast<std::size_t>(firstDigit(count - 1));
  for (std::size_t i = first; i < static_cast<std::size_t>(count); ++i) {
    const std::uint64_t digit = turns.fraction[i];
    const int weight = scale - kDigitBits * static_cast<int>(i);
    if (digit > kDigitMask) {
      digits[length++] = std::ldexp(static_cast<double>(digit >> kDigitBits), weight + kDigitBits);
    }
    digits[length++] = std::ldexp(static_cast<double>(digit & kDigitMask), weight);
  }
  // Times π/2: terms of equal weight are summed without rounding, then smallest first.
  std::array<double, kMostDigits + 1> terms{};
  for (std::size_t m = 0; m < length; ++m) {
    for (std::size_t k = 0; k <= m && k < kPio2Pieces.size(); ++k) terms[m] += kPio2Pieces[k] * digits[m - k];
  }
  double high = 0.0;
  for (std::size_t m = length; m-- > 0;) high += terms[m];
  double low = terms[0] - high;
  for (std::size_t m = 1; m < length; ++m) low += terms[m];
  return turns.negative ? ReducedAngle{turns.quadrant, -high, -low} : ReducedAngle{turns.quadrant, high, low};
}

} // namespace

ReducedAngle reduceAngle(double x) {
  const double magnitude = std::abs(x);
  const std::int32_t word = highWord(magnitude);
  ReducedAngle angle{};
  if (word < 0x4002d97c) { // 3π/4
    angle = reduceSmall(magnitude);
  } else if (word <= 0x413921fb) { // 2^19·π/2
    angle = reduceMedium(magnitude);
  } else {
    angle = reduceLarge(magnitude);
  }
  return x < 0.0 ? ReducedAngle{-angle.quadrant, -angle.high, -angle.low} : angle;
}

} // namespace offstage::strict
