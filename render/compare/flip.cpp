#include "render/compare/flip.h"

#include "render/compare/flip_filters.h"
#include "render/compare/parallel.h"
#include "render/compare/tiles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>

namespace offstage {
namespace {

/// One picture's part that a tile needs, in YCxCz, extended over the picture's edges by its edge pixels.
class TileReader {
public:
  explicit TileReader(const PixelRows& rows)
      : rows_(rows),
        row_(4UL * static_cast<std::size_t>(rows.width())),
        deepRow_(rows.deep() ? row_.size() : 0) {}

  void read(const PixelRect& tile, FlipPlanes& planes) {
    const int columns = tile.right - tile.left + 2 * kFlipReach;
    for (int row = 0; row < tile.bottom - tile.top + 2 * kFlipReach; ++row) {
      const int y = std::clamp(tile.top - kFlipReach + row, 0, rows_.height() - 1);
      const std::uint8_t* from = rowAt(y);
      const std::size_t at = static_cast<std::size_t>(row) * kFlipStride;
      for (int column = 0; column < columns; ++column) {
        const int x = std::clamp(tile.left - kFlipReach + column, 0, rows_.width() - 1);
        const std::uint8_t* rgb = from + 4UL * static_cast<std::size_t>(x);
        const auto to = at + static_cast<std::size_t>(column);
        toYCxCz(rgb, planes.y[to], planes.cx[to], planes.cz[to]);
      }
    }
  }

private:
  const std::uint8_t* rowAt(int y) {
    if (!rows_.deep()) return rows_.row8(y, row_.data());
    rows_.row16(y, deepRow_.data());
    for (std::size_t i = 0; i < row_.size(); ++i) row_[i] = static_cast<std::uint8_t>(deepRow_[i] >> 8U);
    return row_.data();
  }

  const PixelRows& rows_;
  std::vector<std::uint8_t> row_;
  std::vector<std::uint16_t> deepRow_;
};

/// What one thread works in.
struct Workplace {
  Workplace(const PixelRows& reference, const PixelRows& test)
      : referenceReader(reference), testReader(test) {}
  TileReader referenceReader;
  TileReader testReader;
  FlipPlanes planes{}; // narrow tiles leave their rows' ends as they are
  FlipScratch scratch{};
  FlipResponse ofReference{};
  FlipResponse ofTest{};
};

/// The three places where the running sum of the sorted values first exceeds 1/4, 1/2 and 3/4 of `total`.
/// Values are sorted into buckets by their leading bits (of floats ≥ 0 these order as the values do), and
/// only the buckets that matter are sorted further.
void findQuartiles(const std::vector<float>& values, double total, FlipSummary& summary) {
  constexpr unsigned kShift = 14;
  const auto bucketOf = [](float value) { return std::bit_cast<std::uint32_t>(value) >> kShift; };
  std::vector<double> sums((std::bit_cast<std::uint32_t>(2.0F) >> kShift) + 1, 0.0);
  for (const float value : values) sums[bucketOf(value)] += static_cast<double>(value);
  const auto find = [&](double share) {
    double running = 0.0;
    std::size_t bucket = 0;
    while (bucket + 1 < sums.size() && running + sums[bucket] <= share * total) running += sums[bucket++];
    std::vector<float> inside;
    std::ranges::copy_if(values, std::back_inserter(inside),
                         [&](float value) { return bucketOf(value) == bucket; });
    std::ranges::sort(inside);
    for (const float value : inside) {
      running += static_cast<double>(value);
      if (running > share * total) return static_cast<double>(value);
    }
    return inside.empty() ? summary.max : static_cast<double>(inside.back());
  };
  summary.firstQuartile = find(0.25);
  summary.median = find(0.5);
  summary.thirdQuartile = find(0.75);
}

} // namespace

FlipMap flipMap(const PixelRows& reference, const PixelRows& test, int threads) {
  FlipMap map{reference.width(), reference.height(), {}};
  map.errors.assign(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height), 0.0F);
  const std::vector<PixelRect> tiles = unequalTiles(reference, test, kFlipReach, threads);
  std::vector<std::unique_ptr<Workplace>> workplaces(static_cast<std::size_t>(std::max(1, threads)));
  parallelFor(static_cast<int>(tiles.size()), 1, threads, [&](int worker, int index, int) {
    std::unique_ptr<Workplace>& place = workplaces[static_cast<std::size_t>(worker)];
    if (!place) place = std::make_unique<Workplace>(reference, test);
    const PixelRect& tile = tiles[static_cast<std::size_t>(index)];
    const int columns = tile.right - tile.left;
    const int rows = tile.bottom - tile.top;
    place->referenceReader.read(tile, place->planes);
    filterTile(place->planes, rows, place->scratch, place->ofReference);
    place->testReader.read(tile, place->planes);
    filterTile(place->planes, rows, place->scratch, place->ofTest);
    for (int row = 0; row < rows; ++row) {
      float* errors =
          &map.errors[static_cast<std::size_t>(tile.top + row) * static_cast<std::size_t>(map.width) +
                      static_cast<std::size_t>(tile.left)];
      flipErrors(place->ofReference, place->ofTest, row, columns, errors);
    }
  });
  return map;
}

FlipSummary poolFlip(const FlipMap& map) {
  FlipSummary summary;
  double total = 0.0;
  float totalOfTool = 0.0F;
  for (const float error : map.errors) {
    total += static_cast<double>(error);
    totalOfTool += error;
    summary.max = std::max(summary.max, static_cast<double>(error));
  }
  if (total == 0.0) return summary;
  const auto pixels = static_cast<double>(map.errors.size());
  summary.mean = static_cast<double>(totalOfTool) / pixels;
  summary.exactMean = total / pixels;
  findQuartiles(map.errors, total, summary);
  return summary;
}

} // namespace offstage
