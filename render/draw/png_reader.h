#pragma once

#include "render/draw/pixel_rows.h"
#include "render/draw/png_chunks.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace offstage {

/// Pictures of more pixels are refused unless asked for: 16384 × 16384.
constexpr std::int64_t kDefaultMaxPixels = 268435456;

/// A PNG's pixels: every colour type, depth and interlacing, palettes and transparent colours resolved as
/// rows are read. Gamma and colour profiles are not applied.
class PngPicture final : public PixelRows {
public:
  /// Decodes a whole file, which is used up. Strict: a file with any fault (a wrong CRC or checksum, too few
  /// or too many bytes, a palette index beyond the palette) throws std::runtime_error that says what is
  /// wrong, without the file's name.
  explicit PngPicture(std::vector<std::uint8_t> file, std::int64_t maxPixels = kDefaultMaxPixels);

  [[nodiscard]] int width() const override { return chunks_.header.width; }
  [[nodiscard]] int height() const override { return chunks_.header.height; }
  [[nodiscard]] bool deep() const override { return chunks_.header.depth == 16; }
  const std::uint8_t* row8(int y, std::uint8_t* buffer) const override;
  void row16(int y, std::uint16_t* buffer) const override;
  [[nodiscard]] std::span<const std::uint8_t> stored(int y) const override;
  [[nodiscard]] const std::string& layout() const override { return layout_; }

  [[nodiscard]] const PngHeader& header() const { return chunks_.header; }
  /// What a user should know of the file, each a verb phrase: "has 12 bytes after IEND, which are ignored".
  [[nodiscard]] const std::vector<std::string>& notices() const { return chunks_.notices; }

private:
  void inflate();
  void unfilter();
  void unfilterInterlaced();
  void requirePaletteIndices() const;
  void resolvePalette();
  void describeLayout();
  [[nodiscard]] const std::uint8_t* at(int y) const {
    return rows_.get() + 1 + static_cast<std::size_t>(y) * stride_;
  }

  PngChunks chunks_;
  std::unique_ptr<std::uint8_t[]> rows_; ///< each row behind its filter byte
  std::size_t stride_ = 0;
  std::vector<std::uint32_t> colors_; ///< RGBA by palette index, or by grey sample of up to 8 bits
  std::string layout_;
};

} // namespace offstage
