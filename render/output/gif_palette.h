#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace offstage {

using GifColor = std::array<std::uint8_t, 3>; ///< red, green, blue

/// Counts the colours of a clip. Beyond 131072 different ones, similar ones are counted together.
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
  void merge();
  std::unordered_map<std::uint32_t, std::uint64_t> counts_;
  std::uint32_t mask_ = 0xFFFFFFU;
};

/// At most 255 colours for all of a clip. Where there are no more, each is kept exactly. Else those that fill
/// whole areas are kept exactly, so that flat areas stay flat, and the others are gathered by median cut (P.
/// Heckbert, Color image quantization for frame buffer display, SIGGRAPH 1982).
std::vector<GifColor> makePalette(const ColorHistogram& histogram);

/// Finds a palette's index for a pixel by position: ordered dithering between the palette's own colours (the
/// idea of T. Knoll's pattern dithering, US patent 6606166, expired). The result depends on the colour and
/// the place only, so what stands still in the clip stands still in the picture, and a colour of the palette
/// is itself.
class PaletteDither {
public:
  explicit PaletteDither(std::vector<GifColor> palette) : palette_(std::move(palette)) {}
  std::uint8_t index(const std::uint8_t* rgb, int x, int y);

private:
  static constexpr int kSide = 4; ///< px of the pattern
  using Plan = std::array<std::uint8_t, kSide * kSide>;
  Plan plan(const GifColor& color) const;
  [[nodiscard]] std::uint8_t nearest(const std::array<int, 3>& color) const;

  std::vector<GifColor> palette_;
  std::unordered_map<std::uint32_t, Plan> plans_;
};

} // namespace offstage
