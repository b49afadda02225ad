#include "render/draw/text_layout.h"

#include "src/scene/quote.h"
#include "src/scene/utf8.h"
#include "src/sim/error.h"

#include <algorithm>

#include <fmt/format.h>

namespace offstage {
namespace {

/// Hebrew, Arabic and their kin with the marks that turn the direction of writing (Unicode's blocks).
bool isRightToLeft(char32_t c) {
  return (c >= 0x0590 && c <= 0x08ff) || (c >= 0xfb1d && c <= 0xfdff) || (c >= 0xfe70 && c <= 0xfefc) ||
         (c >= 0x200e && c <= 0x200f) || (c >= 0x202a && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069) ||
         (c >= 0x10800 && c <= 0x10fff) || (c >= 0x1e800 && c <= 0x1efff);
}

struct Place {
  int line = 1;
  int character = 1;
};

[[noreturn]] void fail(char32_t character, const Place* place, std::string_view problem) {
  std::string message = fmt::format("{} {} (U+{:04X})", problem, quotedText(encodeUtf8(character)),
                                    static_cast<std::uint32_t>(character));
  if (place != nullptr) message += fmt::format(", line {}, character {}", place->line, place->character);
  throw Error(ExitCode::BadInput, message);
}

/// Calls `visit(glyph)` for every character and `visit(0)` at the end of every line but the last.
template <typename Visit>
void visitGlyphs(const Font& font, std::string_view text, bool whole, Visit visit) {
  const std::u32string characters = decodeUtf8(text);
  Place place;
  const Place* const shown = whole ? &place : nullptr;
  for (std::size_t i = 0; i < characters.size(); ++i) {
    const char32_t c = characters[i];
    if (c == U'\r' && i + 1 < characters.size() && characters[i + 1] == U'\n') continue;
    if (c == U'\n') {
      visit(0U);
      place = {place.line + 1, 1};
      continue;
    }
    if (isRightToLeft(c)) fail(c, shown, "text is set from left to right only, and cannot show");
    const std::uint32_t glyph = font.glyph(c);
    if (glyph == 0) fail(c, shown, "the font has no glyph for");
    visit(glyph);
    ++place.character;
  }
}

} // namespace

TextLayout layOut(const Font& font, std::string_view text) {
  TextLayout layout;
  layout.lines.emplace_back();
  std::uint32_t left = 0;
  visitGlyphs(font, text, true, [&](std::uint32_t glyph) {
    if (glyph == 0) {
      layout.lines.emplace_back();
      left = 0;
      return;
    }
    TextLayout::Line& line = layout.lines.back();
    if (left != 0) line.width += font.kerning(left, glyph);
    line.glyphs.push_back({glyph, line.width});
    line.width += font.advance(glyph);
    left = glyph;
  });
  for (const TextLayout::Line& line : layout.lines) layout.width = std::max(layout.width, line.width);
  return layout;
}

void requireGlyphs(const Font& font, std::string_view text, bool whole) {
  visitGlyphs(font, text, whole, [](std::uint32_t) {});
}

} // namespace offstage
