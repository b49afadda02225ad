#pragma once

#include "render/draw/picture.h"
#include "src/scene/tolerance.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace offstage {

/// Which numbers a comparison computes beyond those that the tolerance needs.
enum class Metrics {
  Fast, ///< counting numbers only: one pass over what differs
  All,  ///< SSIM, the pixelmatch counts and FLIP too
};

/// Two values of one pixel, channels in levels of 255 (fractions when a file has 16 bits a channel).
struct PixelPair {
  int x = 0, y = 0;
  std::array<double, 4> expected{}; ///< red, green, blue, alpha
  std::array<double, 4> actual{};
  double difference = 0.0; ///< levels: the largest of the four channels
};

/// LDR-FLIP errors pooled over a picture (0 equal … 1), as the reference tool pools them: the quartiles are
/// weighted by the error itself.
struct FlipSummary {
  /// As the tool has it, which adds up in single precision, row by row: in pictures of millions of pixels
  /// that loses digits.
  double mean = 0.0;
  double exactMean = 0.0; ///< the same sum in double precision
  double firstQuartile = 0.0;
  double median = 0.0;
  double thirdQuartile = 0.0;
  double max = 0.0;
};

/// All that is known of how an actual picture differs from the expected one.
struct Comparison {
  enum class Kind {
    Same,        ///< within the tolerance
    Differs,     ///< beyond it
    SizeDiffers, ///< of another size; only the sizes below have a meaning
  };
  Kind kind = Kind::Same;
  std::array<int, 2> expectedSize{}; ///< px
  std::array<int, 2> actualSize{};   ///< px

  std::int64_t compared = 0;  ///< px that are not ignored
  std::int64_t ignored = 0;   ///< px in ignored regions and masks
  std::int64_t differing = 0; ///< px beyond Tolerance::maxChannel; forgiven ones not among them
  double ratio = 0.0;         ///< differing / compared
  std::int64_t unequal = 0;   ///< px that are not exactly equal
  PixelRect box;              ///< around the differing pixels; empty when there are none
  std::int64_t clusters = 0;  ///< groups of differing pixels that touch, corners too
  std::int64_t largestCluster = 0;
  PixelRect largestClusterBox;
  double maxChannel = 0.0;   ///< levels: the largest difference of a channel, forgiven pixels included
  double meanChannel = 0.0;  ///< levels: mean of |difference| over red, green, blue, alpha of compared pixels
  double rms = 0.0;          ///< levels: over the same
  double psnr = 0.0;         ///< dB: 20·log10(255/rms); infinite when rms is 0
  std::int64_t forgiven = 0; ///< px, with Tolerance::ignoreAntialiasing
  std::optional<PixelPair> worstForgiven;
  std::vector<PixelPair> worst; ///< the ten differing pixels with the largest difference, worst first

  // With Metrics::All, or where the tolerance asks for one of them.
  std::optional<double> ssim;                   ///< mean, see ssim.h
  std::optional<std::int64_t> pixelmatch;       ///< pixelmatch 7.2.0, threshold 0.1, includeAA false
  std::optional<std::int64_t> pixelmatchWithAa; ///< … includeAA true
  std::optional<FlipSummary> flip;              ///< see flip.h

  std::vector<std::string> failures; ///< one line for each limit that does not hold, with its numbers
  std::vector<std::string> notices;  ///< what a reader should know of the files: "B.png: 12 bytes after IEND"

  [[nodiscard]] bool same() const { return kind == Kind::Same; }
};

} // namespace offstage
