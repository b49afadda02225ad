#include "render/compare/compare_images.h"

#include "render/compare/clusters.h"
#include "render/compare/difference_pass.h"
#include "render/compare/flip.h"
#include "render/compare/frame_rows.h"
#include "render/compare/ignore.h"
#include "render/compare/parallel.h"
#include "render/compare/pixelmatch.h"
#include "render/compare/ssim.h"
#include "render/output/frame_check.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace offstage {
namespace {

void fillCounts(const DifferencePass& pass, Comparison& result) {
  const Clusters clusters = findClusters(pass.differing, result.expectedSize[0], result.expectedSize[1]);
  result.differing = clusters.pixels;
  result.clusters = clusters.count;
  result.largestCluster = clusters.largest;
  result.largestClusterBox = clusters.largestBox;
  result.box = clusters.box;
  result.unequal = pass.sums.unequal;
  result.forgiven = pass.forgivenCount;
  result.worst = pass.worst;
  if (!pass.worstForgiven.empty()) result.worstForgiven = pass.worstForgiven.front();
  if (result.compared > 0)
    result.ratio = static_cast<double>(result.differing) / static_cast<double>(result.compared);
}

void fillErrors(const DifferencePass& pass, Comparison& result) {
  const DifferenceSums& sums = pass.sums;
  // Alpha is a fourth channel only where it differs at all: opaque pictures have three.
  const bool alpha = sums.alphaSum > 0;
  const double values = static_cast<double>(result.compared) * (alpha ? 4.0 : 3.0);
  result.maxChannel = sums.largest * pass.unit;
  if (result.compared > 0) {
    result.meanChannel = static_cast<double>(sums.colorSum + sums.alphaSum) * pass.unit / values;
    const double squares = static_cast<double>(sums.colorSquares) + static_cast<double>(sums.alphaSquares);
    result.rms = std::sqrt(squares / values) * pass.unit;
  }
  result.psnr =
      result.rms > 0.0 ? 20.0 * std::log10(255.0 / result.rms) : std::numeric_limits<double>::infinity();
}

} // namespace

Comparer::Comparer(Tolerance tolerance, Metrics metrics, int threads)
    : tolerance_(std::move(tolerance)), metrics_(metrics), threads_(threads) {}

Comparison Comparer::compare(const PixelRows& expected, const PixelRows& actual) {
  Comparison result;
  result.expectedSize = {expected.width(), expected.height()};
  result.actualSize = {actual.width(), actual.height()};
  if (result.expectedSize != result.actualSize) {
    result.kind = Comparison::Kind::SizeDiffers;
    result.failures.push_back(fmt::format("size differs: expected {}x{} px, actual {}x{} px",
                                          result.expectedSize[0], result.expectedSize[1],
                                          result.actualSize[0], result.actualSize[1]));
    return result;
  }
  const BitPlane& ignored = ignoredFor(expected.width(), expected.height());
  result.ignored = ignored.count();
  result.compared = static_cast<std::int64_t>(expected.width()) * expected.height() - result.ignored;
  const DifferencePass pass = findDifferences(expected, actual,
                                              {tolerance_.maxChannel.value_or(0.0), tolerance_.strictAlpha,
                                               tolerance_.ignoreAntialiasing, &ignored, threads_});
  fillCounts(pass, result);
  fillErrors(pass, result);
  measure(expected, actual, ignored, result);
  judge(result);
  return result;
}

Comparison Comparer::compare(const Frame& expected, const Frame& actual) {
  requireWholeFrame(expected);
  requireWholeFrame(actual);
  return compare(FrameRows(expected), FrameRows(actual));
}

Comparison Comparer::equal(int width, int height) {
  Comparison result;
  result.expectedSize = result.actualSize = {width, height};
  result.ignored = ignoredFor(width, height).count();
  result.compared = static_cast<std::int64_t>(width) * height - result.ignored;
  result.psnr = std::numeric_limits<double>::infinity();
  const bool all = metrics_ == Metrics::All;
  if (all || tolerance_.ssimMin) result.ssim = 1.0;
  if (all || tolerance_.flipMax) result.flip = FlipSummary{};
  if (all) result.pixelmatch = result.pixelmatchWithAa = 0;
  return result;
}

const BitPlane& Comparer::ignoredFor(int width, int height) {
  if (ignoredSize_ != std::pair(width, height)) {
    ignored_ = ignoredPixels(tolerance_, width, height);
    ignoredSize_ = {width, height};
  }
  return ignored_;
}

void Comparer::measure(const PixelRows& expectedRows, const PixelRows& actualRows, const BitPlane& ignored,
                       Comparison& result) const {
  const bool all = metrics_ == Metrics::All;
  if (!all && !tolerance_.flipMax && !tolerance_.ssimMin) return;
  // Measures read rows many times over; converted ones are kept where 8 bits are all there is.
  std::optional<FrameRows> keptExpected;
  std::optional<FrameRows> keptActual;
  const auto kept = [](const PixelRows& rows, std::optional<FrameRows>& frame) -> const PixelRows& {
    if (rows.deep() || rows.layout() == kRgba8Layout) return rows;
    return frame.emplace(toFrame(rows));
  };
  const PixelRows& expected = kept(expectedRows, keptExpected);
  const IgnoringRows without(actualRows, expectedRows, ignored);
  const bool same = &expectedRows == &actualRows;
  const PixelRows& seen = same ? expected : kept(ignored.empty() ? actualRows : without, keptActual);
  if (all || tolerance_.ssimMin) result.ssim = meanSsim(expected, seen, threads_);
  if (all || tolerance_.flipMax) result.flip = poolFlip(flipMap(expected, seen, threads_));
  if (!all) return;
  const PixelmatchCounts counts = pixelmatch(expected, seen, threads_);
  result.pixelmatch = counts.differing;
  result.pixelmatchWithAa = counts.withAa;
}

void Comparer::judge(Comparison& result) const {
  const Tolerance& limits = tolerance_;
  std::vector<std::string>& failures = result.failures;
  if (limits.limitsPixels()) {
    const bool counted = limits.maxPixels || limits.maxRatio || limits.maxCluster;
    const std::int64_t most = limits.maxPixels.value_or(0);
    if ((limits.maxPixels || !counted) && result.differing > most)
      failures.push_back(fmt::format("{} px differ, {} allowed", result.differing, most));
    if (limits.maxRatio && result.ratio > *limits.maxRatio)
      failures.push_back(
          fmt::format("{:.6g} of the pixels differ, {} allowed", result.ratio, *limits.maxRatio));
    if (limits.maxCluster && result.largestCluster > *limits.maxCluster)
      failures.push_back(
          fmt::format("{} differing px touch, {} allowed", result.largestCluster, *limits.maxCluster));
  }
  if (limits.flipMax && result.flip->max > *limits.flipMax)
    failures.push_back(fmt::format("FLIP reaches {:.6f}, {} allowed", result.flip->max, *limits.flipMax));
  if (limits.ssimMin && *result.ssim < *limits.ssimMin)
    failures.push_back(fmt::format("SSIM is {:.6f}, at least {} wanted", *result.ssim, *limits.ssimMin));
  if (limits.maxForgiven && result.forgiven > *limits.maxForgiven)
    failures.push_back(
        fmt::format("{} px forgiven as antialiasing, {} allowed", result.forgiven, *limits.maxForgiven));
  result.kind = failures.empty() ? Comparison::Kind::Same : Comparison::Kind::Differs;
}

Comparison compareImages(const Frame& expected, const Frame& actual, const Tolerance& tolerance,
                         Metrics metrics) {
  return Comparer(tolerance, metrics, defaultThreads()).compare(expected, actual);
}

} // namespace offstage
