#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace offstage {

/// A part of a picture that is not compared, px; what of it lies outside the picture is of no effect.
struct IgnoredRegion {
  int x = 0, y = 0;
  int width = 0, height = 0; ///< ≥ 0
};

/// How far a picture may be from the expected one. Strict by default: no pixel may differ at all.
///
/// A pixel differs when a channel of it is off by more than `maxChannel`. Every limit that is given must
/// hold. When neither maxPixels, maxRatio nor maxCluster is given, no pixel may differ; only a tolerance
/// that gives nothing but flipMax or ssimMin leaves the judgement to these.
struct Tolerance {
  std::optional<double> maxChannel{};       ///< levels of 255, 0 … 255; without it 0
  std::optional<std::int64_t> maxPixels{};  ///< differing pixels, ≥ 0
  std::optional<double> maxRatio{};         ///< differing pixels over compared pixels, 0 … 1
  std::optional<std::int64_t> maxCluster{}; ///< px: of the largest group of differing pixels that touch
                                            ///< (corners too), ≥ 0
  std::optional<double> flipMax{};          ///< largest FLIP error of a pixel, 0 … 1
  std::optional<double> ssimMin{};          ///< mean structural similarity, −1 … 1
  /// Differing pixels that look like a moved antialiased edge are forgiven: counted and drawn apart, and not
  /// held against maxPixels, maxRatio and maxCluster.
  bool ignoreAntialiasing = false;
  /// The cap on what ignoreAntialiasing forgives; without it every such pixel is forgiven.
  std::optional<std::int64_t> maxForgiven{};
  std::vector<IgnoredRegion> ignore{};
  /// Pictures of the expected one's size: what is darker than mid-grey (over white) is not compared.
  std::vector<std::filesystem::path> masks{};
  bool strictAlpha = false; ///< the colour hidden under alpha 0 is compared too

  /// The file that it was read from, for messages; empty: none.
  std::filesystem::path file{};

  /// Whether differing pixels are limited at all; see above.
  [[nodiscard]] bool limitsPixels() const {
    const bool given = maxChannel || maxPixels || maxRatio || maxCluster;
    return given || (!flipMax && !ssimMin);
  }
};

/// The tolerance in words, every limit in force with its value: "no pixel may differ".
std::string toleranceText(const Tolerance& tolerance);

} // namespace offstage
