#pragma once

#include "render/output/atomic_file.h"
#include "render/output/gif_palette.h"
#include "render/raster/frame.h"

#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// Writes a GIF89a file (CompuServe, 1990) with one palette for all of its frames; repeats for ever.
class GifWriter {
public:
  /// The palette's colours are indices 0 …; kUnchanged stands for a pixel that stays as it is.
  static constexpr std::uint8_t kUnchanged = 255;

  GifWriter(AtomicFile& file, int width, int height, const std::vector<GifColor>& palette);

  /// A frame: indices of the pixels of `rect`, rows top-down. `delay` in 1/100 s, 0 … 65535.
  void add(const PixelRect& rect, std::span<const std::uint8_t> indices, std::int64_t delay);
  void finish();
  [[nodiscard]] std::int64_t bytesWritten() const { return bytes_; }

private:
  void put(std::span<const std::uint8_t> bytes);
  void putCompressed(std::span<const std::uint8_t> indices);

  AtomicFile& file_;
  std::int64_t bytes_ = 0;
  std::vector<std::uint32_t> longer_; ///< a hash table of the strings that have a code (putCompressed)
};

} // namespace offstage
