#include "render/draw/text_painter.h"

#include <algorithm>
#include <cmath>

namespace offstage {
namespace {

Rgba8 bytes(const Color& color, double opacity) {
  return {color.red, color.green, color.blue, color.alphaByte(opacity)};
}

/// A coordinate as a whole pixel and quarters of one.
struct PixelPlace {
  int pixel = 0;
  int phase = 0;
};

PixelPlace place(double coordinate, bool whole) {
  constexpr double kFarthest = 1e8; // no canvas reaches so far, and an int does
  const double held = std::clamp(coordinate, -kFarthest, kFarthest);
  if (whole) return {static_cast<int>(std::floor(held + 0.5)), 0};
  const double quarters = std::floor(held * GlyphCache::kPhases + 0.5);
  const double pixel = std::floor(quarters / GlyphCache::kPhases);
  return {static_cast<int>(pixel), static_cast<int>(quarters - pixel * GlyphCache::kPhases)};
}

} // namespace

/// Where everything of a text lies; output px.
struct TextPainter::Block {
  std::shared_ptr<const Font> font;
  TextLayout layout;
  double em = 0.0;            ///< px
  double scale = 0.0;         ///< px a font unit
  Vec2 size = Vec2::Zero();   ///< as it reads: along the lines, then across them
  Vec2 corner = Vec2::Zero(); ///< upper left of the box on the output

  /// The pen at (along, down) of the text as it reads.
  [[nodiscard]] Vec2 pen(double along, double down, bool upwards) const {
    return upwards ? Vec2(corner.x() + down, corner.y() + size.x() - along)
                   : Vec2(corner.x() + along, corner.y() + down);
  }
  [[nodiscard]] Vec2 boxSize(bool upwards) const { return upwards ? Vec2(size.y(), size.x()) : size; }
};

TextPainter::Block TextPainter::set(std::string_view text, const TextLook& look) const {
  Block block;
  block.font = store_->fonts.get(look.font);
  block.layout = layOut(*block.font, text);
  block.em = look.size * viewport_.scale;
  block.scale = block.em / block.font->unitsPerEm();
  const double lines = static_cast<double>(block.layout.lines.size()) - 1.0;
  block.size = {static_cast<double>(block.layout.width) * block.scale,
                (block.font->ascent() + block.font->descent()) * block.scale +
                    lines * look.lineHeight * block.em};
  return block;
}

void TextPainter::require(const TextLook& look, std::string_view text, bool whole) const {
  requireGlyphs(*store_->fonts.get(look.font), text, whole);
}

Vec2 TextPainter::measure(std::string_view text, const TextLook& look) const {
  return set(text, look).boxSize(look.upwards) / viewport_.scale;
}

void TextPainter::draw(Picture& picture, std::string_view text, const TextLook& look, const Vec2& at,
                       double share, bool smooth) const {
  if (!std::isfinite(at.x()) || !std::isfinite(at.y())) return;
  Block block = set(text, look);
  const Vec2 box = block.boxSize(look.upwards);
  block.corner = at * viewport_.scale + viewport_.offset -
                 Vec2(box.x() * acrossOf(look.anchor), box.y() * downOf(look.anchor));
  background(picture, look, block.corner, box, share);
  const double opacity = look.opacity * share;
  if (look.outline && look.outlineWidth > 0.0)
    letters(picture, block, look, bytes(*look.outline, opacity), look.outlineWidth * block.em, smooth);
  letters(picture, block, look, bytes(look.color, opacity), 0.0, smooth);
}

void TextPainter::letters(Picture& picture, const Block& block, const TextLook& look, Rgba8 color,
                          double outline, bool smooth) const {
  if (color.a == 0) return;
  const double slack = look.align == TextAlign::Left ? 0.0 : look.align == TextAlign::Center ? 0.5 : 1.0;
  double baseline = block.font->ascent() * block.scale;
  GlyphKey key{block.font.get(), 0, block.em, outline, 0, 0, look.upwards};
  for (const TextLayout::Line& line : block.layout.lines) {
    const double start = slack * static_cast<double>(block.layout.width - line.width) * block.scale;
    for (const TextLayout::Glyph& glyph : line.glyphs) {
      const Vec2 pen = block.pen(start + static_cast<double>(glyph.x) * block.scale, baseline, look.upwards);
      // Along the line letters stand on quarters of a pixel, so they are evenly spaced; across it the
      // baseline stands on a whole one, so all lines are equally sharp.
      const PixelPlace x = place(pen.x(), look.upwards && !smooth);
      const PixelPlace y = place(pen.y(), !look.upwards && !smooth);
      key.glyph = glyph.index;
      key.phaseX = x.phase;
      key.phaseY = y.phase;
      const GlyphMask& drawn = store_->glyphs.get(key);
      if (drawn.mask != nullptr) mask(picture, drawn.mask, x.pixel + drawn.left, y.pixel + drawn.top, color);
    }
    baseline += look.lineHeight * block.em;
  }
}

void TextPainter::draw(Picture& picture, const std::shared_ptr<const Mask>& drawn, const TextLook& look,
                       const Vec2& at, double share) const {
  if (!std::isfinite(at.x()) || !std::isfinite(at.y())) return;
  const Vec2 size(drawn->width, drawn->height);
  const Vec2 corner = at * viewport_.scale + viewport_.offset -
                      Vec2(size.x() * acrossOf(look.anchor), size.y() * downOf(look.anchor));
  background(picture, look, corner, size, share);
  const Rgba8 color = bytes(look.color, look.opacity * share);
  if (color.a != 0) mask(picture, drawn, place(corner.x(), true).pixel, place(corner.y(), true).pixel, color);
}

/// The box behind a text, on whole pixels, so that its edges are sharp.
void TextPainter::background(Picture& picture, const TextLook& look, const Vec2& corner, const Vec2& size,
                             double share) const {
  if (!look.background) return;
  const double padding = look.padding * look.size * viewport_.scale;
  Primitive box;
  box.kind = Primitive::Kind::Box;
  box.color = bytes(*look.background, look.opacity * share);
  box.low = (corner - Vec2(padding, padding)).array().round();
  box.high = (corner + size + Vec2(padding, padding)).array().round();
  const PixelRect& clip = viewport_.clip;
  const bool seen = box.low.x() < clip.right && box.low.y() < clip.bottom && box.high.x() > clip.left &&
                    box.high.y() > clip.top;
  if (seen && box.color.a != 0) picture.primitives.push_back(box);
}

void TextPainter::mask(Picture& picture, const std::shared_ptr<const Mask>& mask, int left, int top,
                       Rgba8 color) const {
  const PixelRect& clip = viewport_.clip;
  if (left >= clip.right || top >= clip.bottom || left + mask->width <= clip.left ||
      top + mask->height <= clip.top)
    return;
  Primitive primitive;
  primitive.kind = Primitive::Kind::Mask;
  primitive.color = color;
  primitive.low = Vec2(left, top);
  primitive.high = Vec2(left + mask->width, top + mask->height);
  primitive.mask = static_cast<std::int32_t>(picture.masks.size());
  picture.masks.push_back(mask);
  picture.primitives.push_back(primitive);
}

} // namespace offstage
