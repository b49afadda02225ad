#include "render/output/repeat_mask.h"

#include <span>

#ifdef __SSE2__
#include <immintrin.h>
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

void compareWords(const std::uint8_t* row, std::size_t distance, std::span<std::uint64_t> words) {
  for (std::size_t word = 0; word < words.size(); ++word) {
    const std::uint8_t* at = row + word * 64;
    words[word] = equalBytesOf64(at, at - distance);
  }
}

#ifdef __SSE2__
__attribute__((target("avx2"))) void compareWordsWide(const std::uint8_t* row, std::size_t distance,
                                                      std::span<std::uint64_t> words) {
  for (std::size_t word = 0; word < words.size(); ++word) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < 64; i += 32) {
      const std::uint8_t* at = row + word * 64 + i;
      const __m256i equal =
          _mm256_cmpeq_epi8(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(at)),
                            _mm256_loadu_si256(reinterpret_cast<const __m256i*>(at - distance)));
      bits |= std::uint64_t{static_cast<std::uint32_t>(_mm256_movemask_epi8(equal))} << i;
    }
    words[word] = bits;
  }
}
#else
constexpr auto compareWordsWide = compareWords;
#endif

} // namespace

void RepeatMask::compare(const std::uint8_t* row, std::size_t distance) {
  const std::size_t whole = bytes_ / kBits;
  const std::span<std::uint64_t> words = std::span(words_).first(whole);
  wide_ ? compareWordsWide(row, distance, words) : compareWords(row, distance, words);
  const std::uint8_t* rest = row + whole * kBits;
  words_[whole] = equalBytes(rest, rest - distance, bytes_ % kBits);
}

} // namespace offstage
