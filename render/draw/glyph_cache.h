#pragma once

#include "render/draw/font.h"
#include "render/draw/mask.h"

#include <compare>
#include <cstdint>
#include <map>
#include <memory>

namespace offstage {

/// A glyph as pixels.
struct GlyphMask {
  std::shared_ptr<const Mask> mask; ///< null: it has none (a blank)
  int left = 0;                     ///< px from the pen's pixel to the mask's left column
  int top = 0;                      ///< px, down
};

/// Which glyph, and how it lies on the pixels.
struct GlyphKey {
  const Font* font = nullptr;
  std::uint32_t glyph = 0;
  double size = 0.0;    ///< px an em
  double outline = 0.0; ///< px: of a pen drawn around the letter; 0: the letter itself
  int phaseX = 0;       ///< quarters of a pixel that the pen stands right of its pixel's left side, 0 … 3
  int phaseY = 0;       ///< … and below its upper side
  bool upwards = false;
  // clang-tidy 14 takes the defaulted operator's own 0 for a null pointer.
  // NOLINTNEXTLINE(modernize-use-nullptr)
  friend auto operator<=>(const GlyphKey&, const GlyphKey&) = default;
};

/// Rasterized glyphs, each made once. A letter has at most 16 places within a pixel, so that equal letters
/// share their masks and are still evenly spaced. Not thread-safe.
class GlyphCache {
public:
  const GlyphMask& get(const GlyphKey& key); ///< valid as long as the cache

  static constexpr int kPhases = 4;

private:
  std::map<GlyphKey, GlyphMask> masks_;
  std::map<std::pair<const Font*, std::uint32_t>, GlyphOutline> outlines_;
};

} // namespace offstage
