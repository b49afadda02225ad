// FLIP and SSIM against other programs' figures and against themselves computed the long way.

#include "render/compare/compare_images.h"
#include "render/compare/flip.h"
#include "render/compare/frame_rows.h"
#include "render/compare/ssim.h"
#include "render/draw/png_reader.h"
#include "tests/support/reference_csv.h"
#include "tests/support/test_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

const std::filesystem::path kPairs = OFFSTAGE_SOURCE_DIR "/tests/reference/imagediff";

TEST(PeersVerdicts, FlipAndPixelmatchGiveThePeersFigures) {
  const ReferenceCsv peers(kPairs / "peers.csv");
  int compared = 0;
  for (std::size_t row = 0; row < peers.rows(); ++row) {
    if (peers.cell(row, "flip_mean").empty()) continue; // of different sizes
    const std::string name = peers.cell(row, "case");
    std::vector<std::string> notices;
    const auto [a, b] =
        openPictures(kPairs / name / "a.png", kPairs / name / "b.png", kDefaultMaxPixels, notices);
    const Comparison found = Comparer({}, Metrics::All, 2).compare(*a, *b);
    EXPECT_EQ(*found.pixelmatch, peers.integer(row, "pixelmatch_0.1")) << name;
    EXPECT_EQ(*found.pixelmatchWithAa, peers.integer(row, "pixelmatch_0.1_includeAA")) << name;
    const auto figure = [&](const char* column) { return std::stod(peers.cell(row, column)); };
    // The figures have six decimals.
    EXPECT_NEAR(found.flip->mean, figure("flip_mean"), 2e-6) << name;
    EXPECT_NEAR(found.flip->max, figure("flip_max"), 2e-6) << name;
    EXPECT_NEAR(found.flip->thirdQuartile, figure("flip_q3"), 1e-4) << name;
    const std::string intent = peers.cell(row, "intent");
    if (intent == "identical" || intent == "regression") {
      EXPECT_EQ(found.same(), intent == "identical") << name;
    }
    ++compared;
  }
  EXPECT_GE(compared, 25);
}

TEST(Flip, SkippedTilesAreThoseThatAreEqual) {
  // A change near the corners of tiles, in a picture of many: the errors around it are those of the picture
  // cut out with twice the reach of the filters around the change.
  Frame a = noiseFrame(700, 300, 3);
  for (std::size_t i = 3; i < a.rgba.size(); i += 4) a.rgba[i] = 255;
  Frame b = a;
  for (const auto& [x, y] : {std::pair(127, 63), std::pair(128, 64), std::pair(510, 190)})
    b.rgba[4 * pixelIndex(y, 700, x)] ^= 0x80;
  const FlipMap whole = flipMap(FrameRows(a), FrameRows(b), 2);
  const auto cut = [](const Frame& frame, int left, int top) {
    Frame part;
    part.width = part.height = 60;
    for (int y = top; y < top + 60; ++y)
      for (int x = left; x < left + 60; ++x)
        part.rgba.insert(part.rgba.end(), &frame.rgba[4 * pixelIndex(y, 700, x)],
                         &frame.rgba[4 * pixelIndex(y, 700, x)] + 4);
    return part;
  };
  double inside = 0.0;
  for (const auto& [left, top] : {std::pair(98, 34), std::pair(480, 160)}) {
    const FlipMap part = flipMap(FrameRows(cut(a, left, top)), FrameRows(cut(b, left, top)), 1);
    for (int y = 10; y < 50; ++y) {
      for (int x = 10; x < 50; ++x) {
        const float wanted = part.errors[pixelIndex(y, 60, x)];
        ASSERT_EQ(whole.errors[pixelIndex(top + y, 700, left + x)], wanted) << left + x << ", " << top + y;
        inside += static_cast<double>(wanted);
      }
    }
  }
  double all = 0.0;
  for (const float error : whole.errors) all += static_cast<double>(error);
  EXPECT_NEAR(all, inside, 1e-9) << "no error lies farther from a change than the filters reach";
  EXPECT_GT(all, 1.0);
}

TEST(Flip, DoesNotDependOnTheNumberOfThreads) {
  const Frame a = noiseFrame(300, 150, 1);
  const Frame b = noiseFrame(300, 150, 2);
  EXPECT_EQ(flipMap(FrameRows(a), FrameRows(b), 1).errors, flipMap(FrameRows(a), FrameRows(b), 3).errors);
}

TEST(Flip, QuartilesAreThoseOfTheSortedErrors) {
  FlipMap map{1000, 7, {}};
  std::uint32_t state = 1;
  for (int i = 0; i < 7000; ++i) {
    state = state * 1664525U + 1013904223U;
    map.errors.push_back(i % 3 == 0 ? 0.0F : static_cast<float>(state >> 8U) / 16777216.0F);
  }
  std::vector<float> sorted = map.errors;
  std::ranges::sort(sorted);
  double total = 0.0;
  for (const float error : sorted) total += static_cast<double>(error);
  const auto quartile = [&](double share) {
    double running = 0.0;
    for (const float error : sorted)
      if ((running += static_cast<double>(error)) > share * total) return static_cast<double>(error);
    return 1.0;
  };
  const FlipSummary summary = poolFlip(map);
  EXPECT_EQ(summary.firstQuartile, quartile(0.25));
  EXPECT_EQ(summary.median, quartile(0.5));
  EXPECT_EQ(summary.thirdQuartile, quartile(0.75));
  EXPECT_EQ(summary.max, static_cast<double>(sorted.back()));
  EXPECT_NEAR(summary.exactMean, total / 7000.0, 1e-12);
}

/// SSIM as the paper prints it, in doubles.
double plainSsim(const Frame& a, const Frame& b) {
  const auto luma = [](const Frame& frame, int x, int y) {
    const std::uint8_t* p = &frame.rgba[4 * pixelIndex(std::clamp(y, 0, frame.height - 1), frame.width,
                                                       std::clamp(x, 0, frame.width - 1))];
    const double value = 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
    return value * p[3] / 255.0 + 255.0 - p[3];
  };
  std::array<double, 11> w{};
  double sum = 0.0;
  for (int i = 0; i < 11; ++i) sum += w.at(static_cast<std::size_t>(i)) = std::exp(-(i - 5) * (i - 5) / 4.5);
  const auto weightAt = [&w](int offset) { return w.at(static_cast<std::size_t>(offset) + 5); };
  const int margin = std::min(a.width, a.height) < 11 ? 0 : 5;
  double total = 0.0;
  for (int y = margin; y < a.height - margin; ++y) {
    for (int x = margin; x < a.width - margin; ++x) {
      double ma = 0.0;
      double mb = 0.0;
      double aa = 0.0;
      double bb = 0.0;
      double ab = 0.0;
      for (int j = -5; j <= 5; ++j) {
        for (int i = -5; i <= 5; ++i) {
          const double weight = weightAt(i) * weightAt(j) / (sum * sum);
          const double va = luma(a, x + i, y + j);
          const double vb = luma(b, x + i, y + j);
          ma += weight * va;
          mb += weight * vb;
          aa += weight * va * va;
          bb += weight * vb * vb;
          ab += weight * va * vb;
        }
      }
      const double c1 = 6.5025;
      const double c2 = 58.5225;
      total += (2 * ma * mb + c1) * (2 * (ab - ma * mb) + c2) /
               ((ma * ma + mb * mb + c1) * (aa - ma * ma + bb - mb * mb + c2));
    }
  }
  return total / ((a.width - 2.0 * margin) * (a.height - 2.0 * margin));
}

TEST(Ssim, IsThePapersFormula) {
  const std::vector<std::pair<Frame, Frame>> pairs{
      {noiseFrame(40, 33, 1), noiseFrame(40, 33, 2)},
      {lectureFrame(150, 90, 10), lectureFrame(150, 90, 11)},
      {noiseFrame(7, 30, 3), noiseFrame(7, 30, 4)},
      {flatFrame(20, 20, {255, 255, 255, 255}), flatFrame(20, 20, {0, 0, 0, 255})},
  };
  for (const auto& [a, b] : pairs)
    EXPECT_NEAR(meanSsim(FrameRows(a), FrameRows(b), 2), plainSsim(a, b), 2e-6) << a.width << "x" << a.height;
  const Frame same = noiseFrame(50, 50, 9);
  EXPECT_EQ(meanSsim(FrameRows(same), FrameRows(same), 1), 1.0);
}

} // namespace
} // namespace offstage::test
