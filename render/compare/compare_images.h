#pragma once

#include "render/compare/bit_plane.h"
#include "render/compare/comparison.h"
#include "render/draw/pixel_rows.h"
#include "render/raster/frame.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace offstage {

/// Compares pictures under one tolerance. What depends on the tolerance and a size alone (ignored regions,
/// masks) is made once; so one Comparer serves the frames of a sequence. Not for two threads at once.
class Comparer {
public:
  /// `threads`: how many one comparison may use.
  Comparer(Tolerance tolerance, Metrics metrics, int threads);

  /// Pictures of different sizes are a result (Kind::SizeDiffers), not an error. Throws Error(BadInput) when
  /// a mask cannot be read or has another size.
  Comparison compare(const PixelRows& expected, const PixelRows& actual);
  /// The same for frames; throws Error(BadInput) when one is empty.
  Comparison compare(const Frame& expected, const Frame& actual);

  /// The comparison of two pictures of this size that are known to be equal.
  Comparison equal(int width, int height);

  /// What the strip shows in its middle, of the expected picture's size: the expected picture paled, in it
  /// each differing pixel in the colour of how much it differs (violet little, red all), forgiven ones in
  /// yellow, ignored ones hatched. Where sizes differ: of the larger width and height, what only one of the
  /// pictures covers in its own colour.
  Frame difference(const PixelRows& expected, const PixelRows& actual);
  Frame difference(const Frame& expected, const Frame& actual);

  [[nodiscard]] const Tolerance& tolerance() const { return tolerance_; }

private:
  const BitPlane& ignoredFor(int width, int height);
  void measure(const PixelRows& expected, const PixelRows& actual, const BitPlane& ignored,
               Comparison& result) const;
  void judge(Comparison& result) const;

  Tolerance tolerance_;
  Metrics metrics_;
  int threads_;
  std::pair<int, int> ignoredSize_{0, 0};
  BitPlane ignored_;
};

/// One comparison of two frames.
Comparison compareImages(const Frame& expected, const Frame& actual, const Tolerance& tolerance = {},
                         Metrics metrics = Metrics::Fast);

/// expected | difference | actual, side by side with a margin: what `--strip` writes.
Frame makeStrip(const Frame& expected, const Frame& difference, const Frame& actual);

/// Decodes a picture file to compare it: a PNG (strictly, in its own depth), JPEG or BMP. What a reader
/// should know of the file is added to `notices`, each with its name. Throws Error(BadInput) with the file's
/// name and what is wrong with it. More than `maxPixels` are refused before memory is taken.
std::unique_ptr<PixelRows> openPicture(const std::filesystem::path& file, std::int64_t maxPixels,
                                       std::vector<std::string>& notices);

/// Reads and decodes two pictures at the same time, on two threads. A file whose bytes equal the other's is
/// decoded once (it still has to be whole), and both pointers are the same.
std::pair<std::shared_ptr<PixelRows>, std::shared_ptr<PixelRows>>
openPictures(const std::filesystem::path& expected, const std::filesystem::path& actual,
             std::int64_t maxPixels, std::vector<std::string>& notices);

} // namespace offstage
