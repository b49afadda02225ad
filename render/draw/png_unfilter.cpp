#include "render/draw/png_unfilter.h"

#include <cstdlib>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace offstage {
namespace {

enum Filter : std::uint8_t { None, Sub, Up, Average, Paeth, Unknown };

/// The neighbour (left a, above b, above left c) nearest to a + b − c (9.4).
int paethPredictor(int a, int b, int c) {
  const int pa = std::abs(b - c);
  const int pb = std::abs(a - c);
  const int pc = std::abs(a + b - 2 * c);
  if (pa <= pb && pa <= pc) return a;
  return pb <= pc ? b : c;
}

void addUp(std::uint8_t* row, const std::uint8_t* above, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) row[i] = static_cast<std::uint8_t>(row[i] + above[i]);
}

/// For any size of pixel, and for the first row, which has nothing above it (`above` is null).
void unfilterPlain(Filter filter, std::uint8_t* row, const std::uint8_t* above, std::size_t bytes,
                   std::size_t pixel) {
  for (std::size_t i = 0; i < bytes; ++i) {
    const int a = i >= pixel ? row[i - pixel] : 0;
    const int b = above != nullptr ? above[i] : 0;
    const int c = above != nullptr && i >= pixel ? above[i - pixel] : 0;
    int add = 0;
    if (filter == Sub) add = a;
    if (filter == Up) add = b;
    if (filter == Average) add = (a + b) / 2;
    if (filter == Paeth) add = paethPredictor(a, b, c);
    row[i] = static_cast<std::uint8_t>(row[i] + add);
  }
}

#ifdef __SSE2__

/// A pixel's bytes, one to a 16-bit lane.
template <std::size_t Bytes>
__m128i loadPixel(const std::uint8_t* from) {
  __m128i bytes;
  if constexpr (Bytes <= 4) {
    std::int32_t word = 0;
    std::memcpy(&word, from, 4);
    bytes = _mm_cvtsi32_si128(word);
  } else {
    bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from));
  }
  return _mm_unpacklo_epi8(bytes, _mm_setzero_si128());
}

template <std::size_t Bytes>
void storePixel(std::uint8_t* to, __m128i lanes) {
  const __m128i bytes = _mm_packus_epi16(lanes, lanes);
  std::uint64_t word = 0;
  _mm_storel_epi64(reinterpret_cast<__m128i*>(&word), bytes);
  std::memcpy(to, &word, Bytes);
}

__m128i absolute(__m128i x) {
  return _mm_max_epi16(x, _mm_sub_epi16(_mm_setzero_si128(), x));
}

__m128i choose(__m128i mask, __m128i yes, __m128i no) {
  return _mm_or_si128(_mm_and_si128(mask, yes), _mm_andnot_si128(mask, no));
}

/// One pixel at a time with all its channels at once: each needs the one to its left.
template <std::size_t Bytes>
void unfilterPixels(Filter filter, std::uint8_t* row, const std::uint8_t* above, std::size_t bytes) {
  const __m128i low = _mm_set1_epi16(0xFF);
  __m128i a = _mm_setzero_si128();
  __m128i c = _mm_setzero_si128();
  for (std::size_t i = 0; i < bytes; i += Bytes) {
    const __m128i x = loadPixel<Bytes>(row + i);
    __m128i add = a;
    if (filter != Sub) {
      const __m128i b = loadPixel<Bytes>(above + i);
      if (filter == Average) {
        add = _mm_srli_epi16(_mm_add_epi16(a, b), 1);
      } else {
        const __m128i fromA = _mm_sub_epi16(b, c); // a + b − c − a
        const __m128i fromB = _mm_sub_epi16(a, c);
        const __m128i pa = absolute(fromA);
        const __m128i pb = absolute(fromB);
        const __m128i pc = absolute(_mm_add_epi16(fromA, fromB));
        const __m128i least = _mm_min_epi16(pc, _mm_min_epi16(pa, pb));
        add = choose(_mm_cmpeq_epi16(least, pa), a, choose(_mm_cmpeq_epi16(least, pb), b, c));
      }
      c = b;
    }
    a = _mm_and_si128(_mm_add_epi16(x, add), low);
    storePixel<Bytes>(row + i, a);
  }
}

void unfilterRow(Filter filter, std::uint8_t* row, const std::uint8_t* above, std::size_t bytes, int pixel) {
  switch (pixel) {
  case 3:
    return unfilterPixels<3>(filter, row, above, bytes);
  case 4:
    return unfilterPixels<4>(filter, row, above, bytes);
  case 6:
    return unfilterPixels<6>(filter, row, above, bytes);
  case 8:
    return unfilterPixels<8>(filter, row, above, bytes);
  default:
    return unfilterPlain(filter, row, above, bytes, static_cast<std::size_t>(pixel));
  }
}

#else

void unfilterRow(Filter filter, std::uint8_t* row, const std::uint8_t* above, std::size_t bytes, int pixel) {
  unfilterPlain(filter, row, above, bytes, static_cast<std::size_t>(pixel));
}

#endif

} // namespace

std::optional<int> unfilterRows(std::uint8_t* data, int rows, std::size_t rowBytes, int pixelBytes) {
  const std::uint8_t* above = nullptr;
  for (int y = 0; y < rows; ++y) {
    std::uint8_t* row = data + 1;
    const std::uint8_t filter = *data;
    if (filter >= Unknown) return y;
    if (filter != None) {
      if (above == nullptr)
        unfilterPlain(static_cast<Filter>(filter), row, nullptr, rowBytes,
                      static_cast<std::size_t>(pixelBytes));
      else if (filter == Up)
        addUp(row, above, rowBytes);
      else
        unfilterRow(static_cast<Filter>(filter), row, above, rowBytes, pixelBytes);
    }
    above = row;
    data += 1 + rowBytes;
  }
  return std::nullopt;
}

} // namespace offstage
