#pragma once

#include "render/output/pixel_deflate.h"
#include "render/raster/frame.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace offstage {

/// Encodes frames as PNG (ISO/IEC 15948): 8-bit RGB, or RGBA; IHDR, sRGB (perceptual), pHYs when a resolution
/// is given, one IDAT, IEND. Flat pictures are compressed by PixelDeflater, others by libdeflate; the bytes
/// depend only on the arguments and libdeflate's version. Keeps its buffers, so that the frames of a sequence
/// allocate nothing. Not for use from two threads at once.
class PngEncoder {
public:
  PngEncoder();
  ~PngEncoder();
  PngEncoder(const PngEncoder&) = delete;
  PngEncoder& operator=(const PngEncoder&) = delete;

  /// The whole file; valid until the next call. `alpha`: RGBA, else alpha is left out. `dotsPerMetre` > 0
  /// adds a pHYs chunk. Throws Error(BadInput) when the frame is empty, its buffer does not match its size,
  /// or dotsPerMetre < 0.
  std::span<const std::uint8_t> encode(const Frame& frame, bool alpha, int dotsPerMetre = 0);

private:
  struct Compressor;
  /// Gives rows_ the frame's size, and puts its damage there when they hold its base. Whether they hold the
  /// frame then; else all of it has to be packed.
  bool update(const Frame& frame, bool alpha);
  void pack(const Frame& frame, bool alpha, const PixelRect& rect);
  /// Compresses rows_ to file_ from `at` on; returns the size. Packs the frame before, unless it is `there`.
  std::size_t compress(const Frame& frame, bool alpha, bool there, std::size_t at);

  std::optional<PixelDeflater> flat_; ///< for pictures of these:
  int flatWidth_ = 0;
  bool flatAlpha_ = false;
  std::unique_ptr<Compressor> compressor_; ///< null until a picture is not flat
  std::vector<std::uint8_t> rows_;         ///< the filter byte and the pixels of every row
  std::uint64_t packed_ = 0;               ///< id of the frame that rows_ holds; 0: none that can be told
  bool packedAlpha_ = false;
  std::vector<std::uint8_t> file_;
};

/// The same for a single picture.
std::vector<std::uint8_t> encodePng(const Frame& frame, bool alpha, int dotsPerMetre = 0);

} // namespace offstage
