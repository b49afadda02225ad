#pragma once

#include <cstring>

namespace offstage {

/// Two doubles that go through the same operations side by side, each rounded by itself as IEEE 754 says: the
/// bits are those of one after the other, on any processor.
using Two = double __attribute__((vector_size(16)));

inline Two load(const double* values) {
  Two two;
  std::memcpy(&two, values, sizeof two);
  return two;
}

inline void store(double* values, const Two& two) {
  std::memcpy(values, &two, sizeof two);
}

/// The matrix of two rows, turned: its columns.
struct TwoVectors {
  Two x, y;
};
inline TwoVectors turned(const Two& first, const Two& second) {
  return {__builtin_shufflevector(first, second, 0, 2), __builtin_shufflevector(first, second, 1, 3)};
}

} // namespace offstage
