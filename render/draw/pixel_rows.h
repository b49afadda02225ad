#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace offstage {

/// The layout() of pictures that store RGBA, 8 bits a channel.
inline const std::string kRgba8Layout = "rgba8";

/// A decoded picture that keeps its pixels as its file has them and hands out single rows as RGBA. A picture
/// of 4096 × 4096 px in RGB so takes 48 MiB and not 64, and rows that two pictures store alike need not be
/// converted to be found equal.
class PixelRows {
public:
  PixelRows() = default;
  PixelRows(const PixelRows&) = delete;
  PixelRows& operator=(const PixelRows&) = delete;
  virtual ~PixelRows() = default;

  [[nodiscard]] virtual int width() const = 0;  ///< px
  [[nodiscard]] virtual int height() const = 0; ///< px
  /// Whether channels have 16 bits.
  [[nodiscard]] virtual bool deep() const = 0;

  /// Row y as RGBA, 8 bits a channel, not premultiplied: `buffer` (width()·4 bytes) filled, or the stored row
  /// itself where it already is RGBA. Of 16 bits: v·255/65535, rounded.
  virtual const std::uint8_t* row8(int y, std::uint8_t* buffer) const = 0;
  /// Row y as RGBA, 16 bits a channel: 8 bits become v·257. Fills `buffer` (width()·4 values).
  virtual void row16(int y, std::uint16_t* buffer) const = 0;

  /// Row y as it is stored. In pictures of equal layout() equal bytes are equal pixels.
  [[nodiscard]] virtual std::span<const std::uint8_t> stored(int y) const = 0;
  [[nodiscard]] virtual const std::string& layout() const = 0;
};

} // namespace offstage
