#pragma once

#include <bit>
#include <cstdint>

/// The bits of a double as fdlibm looks at them: two 32-bit words, the high one with sign, exponent and the
/// upper 20 bits of the fraction. For the implementation of strict_math.h.
namespace offstage::strict {

inline std::int32_t highWord(double x) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(x) >> 32));
}

inline std::uint32_t lowWord(double x) {
  return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(x));
}

/// High word without the sign: orders by magnitude, and ≥ 0x7ff00000 means infinite or NaN.
inline std::int32_t magnitudeWord(double x) {
  return highWord(x) & 0x7fffffff;
}

inline double fromWords(std::int32_t high, std::uint32_t low) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::uint32_t>(high)) << 32 | low);
}

inline double withHighWord(double x, std::int32_t high) {
  return fromWords(high, lowWord(x));
}

/// x with the lower half of its fraction cleared: a product of two such numbers of 21 bits is exact.
inline double withoutLowWord(double x) {
  return fromWords(highWord(x), 0);
}

/// x·2^n for a result that is a normal number, by its exponent's bits.
inline double addToExponent(double x, int n) {
  return withHighWord(x, static_cast<std::int32_t>(static_cast<std::uint32_t>(highWord(x)) +
                                                   (static_cast<std::uint32_t>(n) << 20)));
}

} // namespace offstage::strict
