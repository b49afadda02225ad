#include "render/output/rgb_pack.h"

#include <cstring>

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace offstage {
namespace {

// Compilers do not vectorise a stride of three well. A store reaches beyond its pixels, which the next one
// writes over; so the last ones are left to another loop.

#ifdef __x86_64__
/// Returns how many pixels it has packed.
__attribute__((target("avx2"))) std::size_t packByEight(const std::uint8_t* rgba, std::uint8_t* rgb,
                                                        std::size_t pixels) {
  // Four pixels of 16 bytes become 12, in each half; then the halves move together.
  const __m256i inHalf = _mm256_setr_epi8(0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, -1, -1, -1, -1, 0, 1, 2, 4,
                                          5, 6, 8, 9, 10, 12, 13, 14, -1, -1, -1, -1);
  const __m256i together = _mm256_setr_epi32(0, 1, 2, 4, 5, 6, 3, 7);
  std::size_t x = 0;
  for (; 3 * x + 32 <= 3 * pixels; x += 8) {
    const __m256i eight = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(rgba + 4 * x));
    const __m256i packed = _mm256_permutevar8x32_epi32(_mm256_shuffle_epi8(eight, inHalf), together);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(rgb + 3 * x), packed);
  }
  return x;
}
#else
std::size_t packByEight(const std::uint8_t* /*rgba*/, std::uint8_t* /*rgb*/, std::size_t /*pixels*/) {
  return 0;
}
#endif

} // namespace

void packRgb(const std::uint8_t* rgba, std::uint8_t* rgb, std::size_t pixels, bool wide) {
  std::size_t x = wide ? packByEight(rgba, rgb, pixels) : 0;
  for (; x + 3 <= pixels; x += 2) { // two in one word
    std::uint64_t two = 0;
    std::memcpy(&two, rgba + 4 * x, sizeof two);
    two = (two & 0xFFFFFFU) | (two >> 8U & 0xFFFFFF000000U);
    std::memcpy(rgb + 3 * x, &two, sizeof two);
  }
  for (; x < pixels; ++x) std::memcpy(rgb + 3 * x, rgba + 4 * x, 3);
}

} // namespace offstage
