#pragma once

#include "render/draw/font_library.h"
#include "render/draw/glyph_cache.h"
#include "render/draw/picture.h"
#include "render/draw/text_layout.h"
#include "src/scene/text_look.h"

#include <memory>
#include <string_view>

namespace offstage {

/// Draws texts into a Picture. Lengths are scene pixels, as those of Painter; a text is set at its size in
/// output pixels, so it is sharp at any scale. Not thread-safe.
class TextPainter {
public:
  explicit TextPainter(const Viewport& viewport) : viewport_(viewport) {}

  [[nodiscard]] const Viewport& viewport() const { return viewport_; }

  /// Reads the look's font, unless it is known, and holds it against a text. Throws as FontLibrary::get() and
  /// requireGlyphs() do.
  void require(const TextLook& look, std::string_view text, bool whole = true) const;

  /// Draws a text so that its look's anchor is at `at` (px): background, then outlines, then letters. `share`
  /// (0 … 1) multiplies the opacity. Baselines stand on whole output pixels unless `smooth`, which is for
  /// texts that move. Throws as require() does.
  void draw(Picture& picture, std::string_view text, const TextLook& look, const Vec2& at, double share = 1.0,
            bool smooth = false) const;

  /// Draws a mask, such as a formula, in the look's colours, its anchor at `at`; `size` is the mask's in px.
  void draw(Picture& picture, const std::shared_ptr<const Mask>& mask, const TextLook& look, const Vec2& at,
            double share = 1.0) const;

  /// Width and height of a text (px), without background and outline.
  [[nodiscard]] Vec2 measure(std::string_view text, const TextLook& look) const;

private:
  struct Block; ///< a text that has been set

  [[nodiscard]] Block set(std::string_view text, const TextLook& look) const;
  void letters(Picture& picture, const Block& block, const TextLook& look, Rgba8 color, double outline,
               bool smooth) const;
  void background(Picture& picture, const TextLook& look, const Vec2& corner, const Vec2& size,
                  double share) const;
  void mask(Picture& picture, const std::shared_ptr<const Mask>& mask, int left, int top, Rgba8 color) const;

  Viewport viewport_;
  /// What drawing reads and makes once; it changes no picture.
  struct Store {
    FontLibrary fonts;
    GlyphCache glyphs;
  };
  std::shared_ptr<Store> store_ = std::make_shared<Store>();
};

} // namespace offstage
