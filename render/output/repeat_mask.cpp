#include "render/output/repeat_mask.h"

#include <algorithm>
#include <cstring>

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace offstage {
namespace {

constexpr std::size_t kPixelBytes = 4;

std::uint32_t pixelAt(const std::uint8_t* at) {
  std::uint32_t pixel = 0;
  std::memcpy(&pixel, at, sizeof pixel);
  return pixel;
}

std::uint64_t equalPixels(const std::uint8_t* a, const std::uint8_t* b, std::size_t count,
                          std::uint32_t compared) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t difference = (pixelAt(a + i * kPixelBytes) ^ pixelAt(b + i * kPixelBytes)) & compared;
    bits |= std::uint64_t{difference == 0} << i;
  }
  return bits;
}

void compareWordsPlain(const std::uint8_t* a, const std::uint8_t* b, std::uint32_t compared,
                       std::span<std::uint64_t> words) {
  for (std::size_t word = 0; word < words.size(); ++word)
    words[word] = equalPixels(a + word * 64 * kPixelBytes, b + word * 64 * kPixelBytes, 64, compared);
}

#ifdef __x86_64__
__attribute__((target("avx2"))) void compareWordsWide(const std::uint8_t* a, const std::uint8_t* b,
                                                      std::uint32_t compared,
                                                      std::span<std::uint64_t> words) {
  const __m256i mask = _mm256_set1_epi32(static_cast<int>(compared));
  for (std::size_t word = 0; word < words.size(); ++word) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < 64; i += 8) {
      const std::size_t at = (word * 64 + i) * kPixelBytes;
      const __m256i eight = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(a + at));
      const __m256i others = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(b + at));
      const __m256i difference = _mm256_and_si256(_mm256_xor_si256(eight, others), mask);
      const __m256i equal = _mm256_cmpeq_epi32(difference, _mm256_setzero_si256());
      bits |= std::uint64_t{static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(equal)))} << i;
    }
    words[word] = bits;
  }
}
#else
constexpr auto compareWordsWide = compareWordsPlain;
#endif

} // namespace

void RepeatMask::compareWords(const std::uint8_t* row, const std::uint8_t* other,
                              std::span<std::uint64_t> words) const {
  const auto compareAll = wide_ ? compareWordsWide : compareWordsPlain;
  compareAll(row, other, compared_, words);
}

void RepeatMask::compareFrom(std::size_t from, const std::uint8_t* row, const std::uint8_t* other) {
  const std::size_t first = from / kBits;
  const std::size_t whole = pixels_ / kBits;
  const auto at = [](const std::uint8_t* pixels, std::size_t word) {
    return pixels + word * kBits * kPixelBytes;
  };
  const std::span<std::uint64_t> words = std::span(words_).subspan(first, whole - first);
  compareWords(at(row, first), at(other, first), words);
  words_[whole] = equalPixels(at(row, whole), at(other, whole), pixels_ % kBits, compared_);
}

void RepeatMask::compare(const std::uint8_t* row, const std::uint8_t* other) {
  compareFrom(0, row, other);
}

void RepeatMask::compareWithPrevious(const std::uint8_t* row) {
  // Before the first pixel there may be no memory that can be read, so the first word is that of the second
  // pixel on, moved up by one.
  if (pixels_ > kBits) {
    compareFrom(kBits, row, row - kPixelBytes);
    compareWords(row + kPixelBytes, row, std::span(words_).first(1));
  } else {
    words_[0] = equalPixels(row + kPixelBytes, row, pixels_ - 1, compared_);
  }
  words_[0] <<= 1U;
}

void RepeatMask::clear() {
  std::ranges::fill(words_, 0);
}

void RepeatMask::setLiterals(const RepeatMask& before, const RepeatMask& above) {
  const std::size_t whole = pixels_ / kBits;
  for (std::size_t word = 0; word <= whole; ++word) {
    const std::uint64_t next = above.words_[word] >> 1U | above.words_[word + 1] << (kBits - 1);
    words_[word] = ~before.words_[word] & ~(above.words_[word] & next);
  }
  words_[whole] &= (std::uint64_t{1} << pixels_ % kBits) - 1;
}

} // namespace offstage
