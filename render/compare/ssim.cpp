#include "render/compare/ssim.h"

#include "render/compare/parallel.h"
#include "render/compare/tiles.h"
#include "render/compare/vector_clones.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace offstage {
namespace {

constexpr int kReach = 5;
constexpr double kDeviation = 1.5; // px
constexpr float kC1 = (0.01F * 255.0F) * (0.01F * 255.0F);
constexpr float kC2 = (0.03F * 255.0F) * (0.03F * 255.0F);
constexpr std::size_t kWidth = kTileWidth;
constexpr std::size_t kStride = kTileWidth + 2 * kReach;
constexpr std::size_t kRows = kTileHeight + 2 * kReach;
constexpr std::size_t kTaps = 2 * kReach + 1;
/// Luma is taken from here, which changes no variance and keeps the products small.
constexpr float kMiddle = 128.0F;

using Window = std::array<float, kTaps>;

const Window& window() {
  static const Window weights = [] {
    Window w{};
    double sum = 0.0;
    std::array<double, kTaps> exact{};
    for (std::size_t i = 0; i < kTaps; ++i) {
      const double x = static_cast<double>(i) - kReach;
      sum += exact[i] = std::exp(-x * x / (2.0 * kDeviation * kDeviation));
    }
    for (std::size_t i = 0; i < kTaps; ++i) w[i] = static_cast<float>(exact[i] / sum);
    return w;
  }();
  return weights;
}

float luma(const std::uint8_t* rgba) {
  const float value = 0.299F * static_cast<float>(rgba[0]) + 0.587F * static_cast<float>(rgba[1]) +
                      0.114F * static_cast<float>(rgba[2]);
  const float alpha = static_cast<float>(rgba[3]) / 255.0F;
  return value * alpha + 255.0F * (1.0F - alpha) - kMiddle;
}

/// What one thread works in: a tile of both pictures with what is around it, and after the window along x.
struct Workplace {
  std::array<float, kStride * kRows> a{}, b{};
  std::array<float, kWidth * kRows> meanA{}, meanB{}, squareA{}, squareB{}, product{};
  std::array<float, kWidth> similarity{};
  std::vector<std::uint8_t> row;
};

void readTile(const PixelRows& rows, const PixelRect& tile, std::vector<std::uint8_t>& buffer,
              std::array<float, kStride * kRows>& plane) {
  buffer.resize(4UL * static_cast<std::size_t>(rows.width()));
  for (int row = 0; row < tile.bottom - tile.top + 2 * kReach; ++row) {
    const std::uint8_t* from =
        rows.row8(std::clamp(tile.top - kReach + row, 0, rows.height() - 1), buffer.data());
    float* to = &plane[static_cast<std::size_t>(row) * kStride];
    for (int column = 0; column < tile.right - tile.left + 2 * kReach; ++column) {
      const int x = std::clamp(tile.left - kReach + column, 0, rows.width() - 1);
      *to++ = luma(from + 4UL * static_cast<std::size_t>(x));
    }
  }
}

OFFSTAGE_VECTOR_CLONES
void windowAlongX(Workplace& place, std::size_t rows) {
  const Window& w = window();
  for (std::size_t row = 0; row < rows; ++row) {
    const float* a = &place.a[row * kStride];
    const float* b = &place.b[row * kStride];
    const std::size_t to = row * kWidth;
    for (std::size_t x = 0; x < kWidth; ++x) {
      float meanA = 0.0F;
      float meanB = 0.0F;
      float squareA = 0.0F;
      float squareB = 0.0F;
      float product = 0.0F;
      for (std::size_t i = 0; i < kTaps; ++i) {
        const float va = a[x + i];
        const float vb = b[x + i];
        meanA += w[i] * va;
        meanB += w[i] * vb;
        squareA += w[i] * (va * va);
        squareB += w[i] * (vb * vb);
        product += w[i] * (va * vb);
      }
      place.meanA[to + x] = meanA;
      place.meanB[to + x] = meanB;
      place.squareA[to + x] = squareA;
      place.squareB[to + x] = squareB;
      place.product[to + x] = product;
    }
  }
}

/// One row of similarities.
OFFSTAGE_VECTOR_CLONES
void windowAlongY(Workplace& place, std::size_t row) {
  const Window& w = window();
  for (std::size_t x = 0; x < kWidth; ++x) {
    float meanA = 0.0F;
    float meanB = 0.0F;
    float squareA = 0.0F;
    float squareB = 0.0F;
    float product = 0.0F;
    for (std::size_t i = 0; i < kTaps; ++i) {
      const std::size_t at = (row + i) * kWidth + x;
      meanA += w[i] * place.meanA[at];
      meanB += w[i] * place.meanB[at];
      squareA += w[i] * place.squareA[at];
      squareB += w[i] * place.squareB[at];
      product += w[i] * place.product[at];
    }
    const float varianceA = squareA - meanA * meanA;
    const float varianceB = squareB - meanB * meanB;
    const float covariance = product - meanA * meanB;
    const float fullA = meanA + kMiddle;
    const float fullB = meanB + kMiddle;
    place.similarity[x] = ((2.0F * fullA * fullB + kC1) * (2.0F * covariance + kC2)) /
                          ((fullA * fullA + fullB * fullB + kC1) * (varianceA + varianceB + kC2));
  }
}

} // namespace

double meanSsim(const PixelRows& a, const PixelRows& b, int threads) {
  const bool small = std::min(a.width(), a.height()) < 2 * kReach + 1;
  const int margin = small ? 0 : kReach;
  const std::vector<PixelRect> tiles = unequalTiles(a, b, kReach, threads);
  // What is missing to 1, tile by tile, so that the sum does not depend on who computed what.
  std::vector<double> missing(tiles.size(), 0.0);
  std::vector<std::unique_ptr<Workplace>> workplaces(static_cast<std::size_t>(std::max(1, threads)));
  parallelFor(static_cast<int>(tiles.size()), 1, threads, [&](int worker, int index, int) {
    std::unique_ptr<Workplace>& place = workplaces[static_cast<std::size_t>(worker)];
    if (!place) place = std::make_unique<Workplace>();
    const PixelRect& tile = tiles[static_cast<std::size_t>(index)];
    readTile(a, tile, place->row, place->a);
    readTile(b, tile, place->row, place->b);
    windowAlongX(*place, static_cast<std::size_t>(tile.bottom - tile.top) + 2 * kReach);
    double sum = 0.0;
    for (int y = std::max(tile.top, margin); y < std::min(tile.bottom, a.height() - margin); ++y) {
      windowAlongY(*place, static_cast<std::size_t>(y - tile.top));
      for (int x = std::max(tile.left, margin); x < std::min(tile.right, a.width() - margin); ++x)
        sum += 1.0 - static_cast<double>(place->similarity[static_cast<std::size_t>(x - tile.left)]);
    }
    missing[static_cast<std::size_t>(index)] = sum;
  });
  double sum = 0.0;
  for (const double part : missing) sum += part;
  const double places =
      static_cast<double>(a.width() - 2 * margin) * static_cast<double>(a.height() - 2 * margin);
  return 1.0 - sum / places;
}

} // namespace offstage
