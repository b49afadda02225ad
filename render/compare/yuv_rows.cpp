#include "render/compare/yuv_rows.h"

#include "render/compare/vector_clones.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace offstage {
namespace {

/// Chroma is kept in eighths, so that no interpolation rounds.
constexpr int kChromaOne = 8;
constexpr int kShift = 16;

/// Factors of 2^16: R = y·(Y − black) + rv·V, G = … + gu·U + gv·V, B = … + bu·U, U and V from their middle in
/// eighths.
struct Matrix {
  std::int32_t y, rv, gu, gv, bu, black;
};

/// From the weights of red and blue in Y (ITU-R BT.601, BT.709) and the ranges of Y and chroma.
Matrix matrixOf(bool highDefinition, bool fullRange) {
  const double kr = highDefinition ? 0.2126 : 0.299;
  const double kb = highDefinition ? 0.0722 : 0.114;
  const double kg = 1.0 - kr - kb;
  const double luma = fullRange ? 1.0 : 255.0 / 219.0;
  const double chroma = (fullRange ? 1.0 : 255.0 / 224.0) * 2.0 / kChromaOne;
  const auto fixed = [](double factor) {
    return static_cast<std::int32_t>(std::lround(factor * (1 << kShift)));
  };
  return {fixed(luma),
          fixed(chroma * (1.0 - kr)),
          fixed(-chroma * (1.0 - kb) * kb / kg),
          fixed(-chroma * (1.0 - kr) * kr / kg),
          fixed(chroma * (1.0 - kb)),
          fullRange ? 0 : 16};
}

/// A chroma row at the height of a luma row, one value a luma column, in eighths from the middle. `near` and
/// `far`: the chroma rows a quarter and three quarters of a row away.
OFFSTAGE_VECTOR_CLONES
void spreadChroma(const std::uint8_t* near, const std::uint8_t* far, std::size_t columns, std::int32_t* mixed,
                  std::int32_t* out) {
  for (std::size_t i = 0; i < columns; ++i) mixed[i] = 3 * near[i] + far[i] - 4 * 128;
  mixed[columns] = mixed[columns - 1];
  for (std::size_t i = 0; i < columns; ++i) {
    out[2 * i] = 2 * mixed[i];
    out[2 * i + 1] = mixed[i] + mixed[i + 1];
  }
}

OFFSTAGE_VECTOR_CLONES
void convertRow(const Matrix& m, const std::uint8_t* y, const std::int32_t* u, const std::int32_t* v,
                std::size_t columns, std::uint32_t* out) {
  constexpr std::int32_t kHalf = 1 << (kShift - 1);
  for (std::size_t x = 0; x < columns; ++x) {
    const std::int32_t luma = m.y * (y[x] - m.black) + kHalf;
    const std::int32_t r = (luma + m.rv * v[x]) >> kShift;
    const std::int32_t g = (luma + m.gu * u[x] + m.gv * v[x]) >> kShift;
    const std::int32_t b = (luma + m.bu * u[x]) >> kShift;
    const auto red = static_cast<std::uint32_t>(std::min(std::max(r, 0), 255));
    const auto green = static_cast<std::uint32_t>(std::min(std::max(g, 0), 255));
    const auto blue = static_cast<std::uint32_t>(std::min(std::max(b, 0), 255));
    out[x] = red | (green << 8U) | (blue << 16U) | 0xFF000000U;
  }
}

} // namespace

void toRgba(const Yuv420& picture, Frame& frame) {
  const auto width = static_cast<std::size_t>(picture.width);
  const int chromaRows = (picture.height + 1) / 2;
  const std::size_t chromaColumns = (width + 1) / 2;
  frame.width = picture.width;
  frame.height = picture.height;
  frame.rgba.resize(4 * width * static_cast<std::size_t>(picture.height));
  const Matrix matrix = matrixOf(picture.highDefinition, picture.fullRange);
  std::vector<std::int32_t> mixed(chromaColumns + 1);
  std::vector<std::int32_t> u(2 * chromaColumns);
  std::vector<std::int32_t> v(2 * chromaColumns);
  std::vector<std::uint32_t> row(width);
  for (int y = 0; y < picture.height; ++y) {
    const int near = y / 2;
    const int far = std::clamp(near + (y % 2 == 0 ? -1 : 1), 0, chromaRows - 1);
    spreadChroma(picture.u + near * picture.uStride, picture.u + far * picture.uStride, chromaColumns,
                 mixed.data(), u.data());
    spreadChroma(picture.v + near * picture.vStride, picture.v + far * picture.vStride, chromaColumns,
                 mixed.data(), v.data());
    convertRow(matrix, picture.y + y * picture.yStride, u.data(), v.data(), width, row.data());
    std::memcpy(&frame.rgba[4 * width * static_cast<std::size_t>(y)], row.data(), 4 * width);
  }
}

} // namespace offstage
