#pragma once

#include "src/sim/vec.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace offstage {

/// A glyph's outline: closed contours of straight lines and Bézier curves, in font units, y up, the pen at
/// (0, 0). A contour's first point is where it starts; `through` are a curve's control points.
struct GlyphOutline {
  struct Segment {
    int controls = 0; ///< 0: a line, 1: quadratic, 2: cubic
    Vec2 through[2] = {Vec2::Zero(), Vec2::Zero()};
    Vec2 to = Vec2::Zero();
  };
  struct Contour {
    Vec2 start = Vec2::Zero();
    std::vector<Segment> segments;
  };
  std::vector<Contour> contours;
};

/// A TrueType or OpenType font: what it says of its characters, in whole font units, so that nothing depends
/// on how a library scales or hints. FreeType reads the file, because it is held to hostile fonts:
/// stb_truetype writes past its arrays for contours whose ends are out of order. Not thread-safe.
class Font {
public:
  /// Throws std::runtime_error that says what is wrong, without a file's name.
  explicit Font(std::vector<std::uint8_t> bytes);
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  [[nodiscard]] std::uint32_t glyph(char32_t character) const; ///< 0: the font has none
  [[nodiscard]] int unitsPerEm() const;
  [[nodiscard]] int ascent() const;  ///< above the baseline, > 0
  [[nodiscard]] int descent() const; ///< below the baseline, > 0
  /// How far the pen goes on. Throws Error(BadInput) when the glyph is damaged, as outline() does.
  [[nodiscard]] int advance(std::uint32_t glyph) const;
  [[nodiscard]] int kerning(std::uint32_t left, std::uint32_t right) const; ///< added between two glyphs
  [[nodiscard]] GlyphOutline outline(std::uint32_t glyph) const;

private:
  struct Face;
  std::unique_ptr<Face> face_;
};

} // namespace offstage
