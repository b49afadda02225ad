#pragma once

#include "render/output/color_table.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

using GifColor = std::array<std::uint8_t, 3>; ///< red, green, blue

/// A colour as a number whose order is that of red, then green, then blue.
inline std::uint32_t keyOfColor(const std::uint8_t* rgb) {
  return static_cast<std::uint32_t>(rgb[0]) << 16U | static_cast<std::uint32_t>(rgb[1]) << 8U | rgb[2];
}
inline GifColor colorOfKey(std::uint32_t key) {
  return {static_cast<std::uint8_t>(key >> 16U), static_cast<std::uint8_t>(key >> 8U),
          static_cast<std::uint8_t>(key)};
}

/// Counts the colours of a clip. Beyond 131072 different ones, similar ones are counted together, under the
/// one that is most frequent among them: a background keeps its colour.
class ColorHistogram {
public:
  /// Opaque pixels only: a transparent one stands for no change.
  void add(std::span<const std::uint8_t> rgba);
  struct Entry {
    GifColor color{};
    std::uint64_t count = 0;
  };
  [[nodiscard]] std::vector<Entry> entries() const; ///< in the order of the colours' values

private:
  /// Colours that are counted together.
  struct Group {
    std::uint64_t count = 0;
    std::uint32_t color = 0;      ///< the most frequent
    std::uint64_t colorCount = 0; ///< its own count, or since it became that
    void add(std::uint32_t color, std::uint64_t colorCount, std::uint64_t count);
  };
  void merge();
  ColorTable<Group> groups_;
  std::uint32_t mask_ = 0xFFFFFFU;
};

/// At most 255 colours for all of a clip. Where there are no more, each is kept exactly. Else those that fill
/// whole areas are kept exactly, so that flat areas stay flat, and the others are gathered by median cut (P.
/// Heckbert, Color image quantization for frame buffer display, SIGGRAPH 1982).
std::vector<GifColor> makePalette(const ColorHistogram& histogram);

} // namespace offstage
