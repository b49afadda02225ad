#pragma once

#include "render/draw/font.h"
#include "src/scene/text_look.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace offstage {

/// A text as lines of glyphs. Lengths in font units, so that a layout fits every size.
struct TextLayout {
  struct Glyph {
    std::uint32_t index = 0;
    std::int64_t x = 0; ///< of its pen, from the line's left end; kerning is in it
  };
  struct Line {
    std::vector<Glyph> glyphs;
    std::int64_t width = 0;
  };
  std::vector<Line> lines; ///< at least one
  std::int64_t width = 0;  ///< of the longest line
};

/// Sets a UTF-8 text; "\n" or "\r\n" ends a line. Throws Error(BadInput) at what is not UTF-8 and at a
/// character that the font has no glyph for (or whose script is written from right to left, which this
/// does not set), naming it and its place.
TextLayout layOut(const Font& font, std::string_view text);

/// Throws as layOut() does, unless the font has a glyph for every character. `whole`: the text is all there
/// is, so that the error names the character's place in it, too.
void requireGlyphs(const Font& font, std::string_view text, bool whole = true);

} // namespace offstage
