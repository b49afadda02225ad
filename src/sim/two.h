#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace offstage {

/// Two doubles that go through the same operations side by side, each rounded by itself as IEEE 754 says: the
/// bits are those of one after the other, on any processor.
using Two = double __attribute__((vector_size(16)));

/// Of two comparisons: −1 or 0.
using TwoBits = std::int64_t __attribute__((vector_size(16)));

inline Two load(const double* values) {
  Two two;
  std::memcpy(&two, values, sizeof two);
  return two;
}

inline void store(double* values, const Two& two) {
  std::memcpy(values, &two, sizeof two);
}

/// Rounded as IEEE 754 says, like all of these.
inline Two squareRoot(const Two& two) {
  return Two{std::sqrt(two[0]), std::sqrt(two[1])};
}

/// Bit 0 and bit 1 of a comparison.
inline std::uint32_t maskOf(const TwoBits& bits) {
#if defined(__SSE2__)
  return static_cast<std::uint32_t>(_mm_movemask_pd(reinterpret_cast<__m128d>(bits)));
#else
  return static_cast<std::uint32_t>(bits[0] & 1) | static_cast<std::uint32_t>(bits[1] & 2);
#endif
}

/// `a` where a comparison held, else `b`; without a branch, which `?:` may become.
inline Two select(const TwoBits& bits, const Two& a, const Two& b) {
  return reinterpret_cast<Two>((reinterpret_cast<TwoBits>(a) & bits) |
                               (reinterpret_cast<TwoBits>(b) & ~bits));
}

/// Whether both are finite.
inline bool bothFinite(const Two& two) {
  // NOLINTNEXTLINE(misc-redundant-expression): of infinity and of NaN it is NaN
  return maskOf(two - two == Two{}) == 3;
}

/// The matrix of two rows, turned: its columns.
struct TwoVectors {
  Two x, y;
};
inline TwoVectors turned(const Two& first, const Two& second) {
  return {__builtin_shufflevector(first, second, 0, 2), __builtin_shufflevector(first, second, 1, 3)};
}

} // namespace offstage
