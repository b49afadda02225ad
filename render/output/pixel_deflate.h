#pragma once

#include "render/output/deflate_block.h"
#include "render/output/repeat_mask.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace offstage {

/// Deflate (RFC 1951, in a stream of RFC 1950) for rows of flat colours as PNG has them: a byte that names
/// the filter, then pixels. It knows of two repetitions only: of the pixel before, and of the row above,
/// where deflate's 32 KiB reach that far. On flat pictures with antialiased edges that makes files as small
/// as a search of the whole window (png.cpp has the figures) in a fraction of the time. The bytes depend on
/// nothing but the rows. Keeps its buffers, and is not for two threads at once.
class PixelDeflater {
public:
  /// `channels`: bytes a pixel, 3 or 4. `width` ≥ 1.
  PixelDeflater(std::size_t width, std::size_t channels);

  /// Writes the stream of whole rows to `to` and returns its size. 0 when the picture is not flat (of more
  /// than a quarter of its pixels neither neighbour is a repetition), or when the stream might not fit; what
  /// `to` holds then means nothing. `rgba`: the same pixels, 4 bytes each and nothing between rows, which are
  /// quicker to compare; without alpha (3 channels) its fourth bytes do not matter. `prepare` is called with
  /// the number of each row before that is read, from the first on: what it writes there is still in the
  /// cache.
  std::size_t compress(std::span<const std::uint8_t> rows, const std::uint8_t* rgba,
                       const std::function<void(std::size_t row)>& prepare, std::span<std::uint8_t> to);

private:
  /// `rgba`: the row's pixels, those of the row above in front of them.
  template <std::size_t Channels>
  void addRow(const std::uint8_t* row, const std::uint8_t* rgba, bool above);
  void addMatch(std::size_t length, bool above);

  std::size_t width_;
  std::size_t channels_;
  std::size_t rowBytes_;
  bool reachesAbove_;
  RepeatMask before_; ///< pixels that repeat the one before them
  RepeatMask above_;  ///< pixels that repeat the one above them, where that is near enough
  RepeatMask literals_;
  DeflateBlock block_;
  std::size_t literalPixels_ = 0;
};

} // namespace offstage
