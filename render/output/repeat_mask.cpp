#include "render/output/repeat_mask.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace offstage {
namespace {

std::uint64_t equalBytes(const std::uint8_t* a, const std::uint8_t* b, std::size_t count) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < count; ++i) bits |= std::uint64_t{a[i] == b[i]} << i;
  return bits;
}

#ifdef __SSE2__
std::uint64_t equalBytesOf64(const std::uint8_t* a, const std::uint8_t* b) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < 64; i += 16) {
    const __m128i equal = _mm_cmpeq_epi8(_mm_loadu_si128(reinterpret_cast<const __m128i*>(a + i)),
                                         _mm_loadu_si128(reinterpret_cast<const __m128i*>(b + i)));
    bits |= std::uint64_t{static_cast<std::uint32_t>(_mm_movemask_epi8(equal))} << i;
  }
  return bits;
}
#else
std::uint64_t equalBytesOf64(const std::uint8_t* a, const std::uint8_t* b) {
  return equalBytes(a, b, 64);
}
#endif

} // namespace

void RepeatMask::compare(const std::uint8_t* row, std::size_t distance) {
  const std::size_t whole = bytes_ / kBits;
  for (std::size_t word = 0; word < whole; ++word) {
    const std::uint8_t* at = row + word * kBits;
    words_[word] = equalBytesOf64(at, at - distance);
  }
  const std::uint8_t* rest = row + whole * kBits;
  words_[whole] = equalBytes(rest, rest - distance, bytes_ % kBits);
}

} // namespace offstage
