#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace offstage {

/// What a PNG's header says (ISO/IEC 15948, 11.2.2).
struct PngHeader {
  enum class Color : std::uint8_t { Grey = 0, Rgb = 2, Palette = 3, GreyAlpha = 4, Rgba = 6 };
  int width = 0;  ///< px, ≥ 1
  int height = 0; ///< px, ≥ 1
  int depth = 8;  ///< bits a sample: 1, 2, 4, 8 or 16
  Color color = Color::Rgba;
  bool interlaced = false; ///< Adam7

  [[nodiscard]] int channels() const; ///< stored samples a pixel: 1 to 4
  [[nodiscard]] int pixelBits() const { return channels() * depth; }
  /// Bytes of a row of `pixels` pixels, without its filter byte.
  [[nodiscard]] std::size_t rowBytes(int pixels) const;
};

/// A PNG taken apart: what stands around its pixels.
struct PngChunks {
  PngHeader header;
  std::vector<std::uint8_t> palette;      ///< red, green, blue; empty without one
  std::vector<std::uint8_t> transparency; ///< tRNS as stored: alpha by palette index, or a colour's samples
  std::optional<std::uint32_t> gamma;     ///< gAMA: 100000 times the file's gamma
  std::span<const std::uint8_t> data;     ///< the zlib stream, in the bytes given
  std::vector<std::string> notices;       ///< "12 bytes after IEND are ignored"
};

/// Whether the bytes begin with a PNG's signature.
bool isPng(std::span<const std::uint8_t> file);

/// Takes a PNG apart. Every chunk's CRC is checked, and all that the standard asks of the order and contents
/// of the chunks that matter to the pixels. Throws std::runtime_error that says what is wrong and where: a
/// file that is not whole has no pixels. `file` is changed: its IDAT chunks are moved together. A picture of
/// more than `maxPixels` is refused before memory is taken.
PngChunks readPngChunks(std::span<std::uint8_t> file, std::int64_t maxPixels);

} // namespace offstage
