#include "render/draw/font.h"
#include "render/draw/glyph_cache.h"
#include "render/draw/text_layout.h"
#include "src/sim/error.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

/// Any bytes are a font whose letters can be drawn, or are refused with an exception.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const offstage::Font font(std::vector<std::uint8_t>(data, data + size));
    offstage::GlyphCache cache;
    for (const char32_t character : U"AVgé.09{∆") {
      const std::uint32_t glyph = font.glyph(character);
      if (glyph == 0) continue;
      static_cast<void>(font.advance(glyph) + font.kerning(glyph, glyph));
      static_cast<void>(cache.get({&font, glyph, 30.0, 0.0, 1, 0, false}));
      static_cast<void>(cache.get({&font, glyph, 12.0, 1.5, 0, 0, true}));
    }
    static_cast<void>(offstage::layOut(font, "AV"));
  } catch (const std::runtime_error&) {
    return 0;
  }
  return 0;
}
