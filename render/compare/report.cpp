#include "render/compare/report.h"

#include "render/output/png.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace offstage {
namespace {

std::vector<std::int64_t> sides(const PixelRect& box) {
  return {box.left, box.top, box.right - box.left, box.bottom - box.top};
}

bool opaque(const Frame& frame) {
  for (std::size_t i = 3; i < frame.rgba.size(); i += 4)
    if (frame.rgba[i] != 255) return false;
  return true;
}

std::string_view verdictOf(Comparison::Kind kind) {
  switch (kind) {
  case Comparison::Kind::Same:
    return "same";
  case Comparison::Kind::Differs:
    return "differs";
  case Comparison::Kind::SizeDiffers:
    break;
  }
  return "size differs";
}

/// How bad it looks, 0 … 1: FLIP's third quartile, which orders noise below regressions best; without FLIP
/// the largest difference, less where only specks differ. A size that differs stands above all.
double severityOf(const Comparison& comparison) {
  if (comparison.kind == Comparison::Kind::SizeDiffers) return 2.0;
  if (comparison.flip) return comparison.flip->thirdQuartile;
  const double together =
      std::min(1.0, std::log2(1.0 + static_cast<double>(comparison.largestCluster)) / 6.0);
  return comparison.maxChannel / 255.0 * together;
}

} // namespace

ReportPicture reportPicture(const Frame& frame) {
  return std::make_shared<const std::vector<std::uint8_t>>(encodePng(frame, !opaque(frame)));
}

std::vector<ReportNumber> reportNumbers(const Comparison& c) {
  std::vector<ReportNumber> numbers;
  const auto add = [&numbers](const char* key, const char* label, auto value, const char* unit = "") {
    numbers.push_back({key, label, value, unit});
  };
  const auto size = [](const std::array<int, 2>& s) { return std::vector<std::int64_t>{s[0], s[1]}; };
  if (c.kind == Comparison::Kind::SizeDiffers) {
    add("expected_size", "expected size", size(c.expectedSize), "px");
    add("actual_size", "actual size", size(c.actualSize), "px");
    return numbers;
  }
  add("size", "size", size(c.expectedSize), "px");
  add("differing_pixels", "differing pixels", c.differing, "px");
  add("differing_ratio", "share", c.ratio);
  if (c.unequal != c.differing + c.forgiven) add("unequal_pixels", "not exactly equal", c.unequal, "px");
  if (c.ignored > 0) add("ignored_pixels", "ignored", c.ignored, "px");
  if (c.differing > 0) {
    add("bounding_box", "bounding box (x, y, width, height)", sides(c.box), "px");
    add("clusters", "clusters", c.clusters);
    add("largest_cluster", "largest cluster", c.largestCluster, "px");
    add("largest_cluster_box", "its box (x, y, width, height)", sides(c.largestClusterBox), "px");
  }
  add("max_channel_difference", "max channel difference", c.maxChannel, "of 255");
  add("mean_channel_difference", "mean channel difference", c.meanChannel, "of 255");
  add("rms", "RMS", c.rms, "of 255");
  add("psnr", "PSNR", c.psnr, "dB");
  if (c.ssim) add("ssim", "SSIM", *c.ssim);
  if (c.pixelmatch) add("pixelmatch", "pixelmatch (threshold 0.1)", *c.pixelmatch, "px");
  if (c.pixelmatchWithAa)
    add("pixelmatch_include_aa", "pixelmatch with includeAA", *c.pixelmatchWithAa, "px");
  if (c.flip) {
    add("flip_mean", "FLIP mean", c.flip->mean);
    add("flip_mean_exact", "FLIP mean, summed exactly", c.flip->exactMean);
    add("flip_q1", "FLIP first weighted quartile", c.flip->firstQuartile);
    add("flip_median", "FLIP weighted median", c.flip->median);
    add("flip_q3", "FLIP third weighted quartile", c.flip->thirdQuartile);
    add("flip_max", "FLIP max", c.flip->max);
  }
  add("forgiven_pixels", "forgiven as antialiasing", c.forgiven, "px");
  if (c.worstForgiven) {
    add("worst_forgiven", "worst forgiven at",
        std::vector<std::int64_t>{c.worstForgiven->x, c.worstForgiven->y}, "px");
    add("worst_forgiven_difference", "its difference", c.worstForgiven->difference, "of 255");
  }
  return numbers;
}

ReportCase reportCase(const std::string& name, const Comparison& comparison) {
  ReportCase result;
  result.name = name;
  result.passed = comparison.same();
  result.verdict = verdictOf(comparison.kind);
  result.lines = comparison.failures;
  result.lines.insert(result.lines.end(), comparison.notices.begin(), comparison.notices.end());
  result.severity = severityOf(comparison);
  result.numbers = reportNumbers(comparison);
  result.worst = comparison.worst;
  return result;
}

} // namespace offstage
