#pragma once

#include "src/scene/color.h"
#include "src/scene/diagnostic.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace offstage {

/// One of a rectangle's nine positions, row by row.
enum class NinePosition : std::uint8_t {
  TopLeft,
  Top,
  TopRight,
  Left,
  Center,
  Right,
  BottomLeft,
  Bottom,
  BottomRight
};

/// The position as fractions of width and height: 0, 0.5 or 1.
constexpr double acrossOf(NinePosition position) {
  return 0.5 * (static_cast<int>(position) % 3);
}
constexpr double downOf(NinePosition position) {
  const int row = static_cast<int>(position) / 3;
  return 0.5 * row;
}

enum class TextAlign : std::uint8_t { Left, Center, Right };

/// How lines are aligned that stand at this anchor.
constexpr TextAlign sideOf(NinePosition anchor) {
  return static_cast<TextAlign>(static_cast<int>(anchor) % 3);
}

/// The typefaces that come with Offstage's packages: DejaVu of Debian's fonts-dejavu-core.
enum class Typeface : std::uint8_t { Sans, SansBold, Mono, MonoBold };

/// Which font a text is set in.
struct FontChoice {
  Typeface typeface = Typeface::Sans;
  std::filesystem::path file; ///< TTF or OTF; empty: the typeface
  SourceLocation where;       ///< of the scene's key, for errors in the file; empty from C++
};

/// How a text looks.
struct TextLook {
  FontChoice font;
  double size = 24.0; ///< px: the font's em, > 0
  Color color;
  double opacity = 1.0;                       ///< 0 … 1, of all of it
  NinePosition anchor = NinePosition::Center; ///< of the text's box: what stands at the given point
  TextAlign align = TextAlign::Center;        ///< of the lines of several
  double lineHeight = 1.25;                   ///< em: from baseline to baseline
  std::optional<Color> background;            ///< a box behind the text
  double padding = 0.3;                       ///< em: of the box, around the text
  std::optional<Color> outline;               ///< around every letter, outside of it
  double outlineWidth = 0.1;                  ///< em
  bool upwards = false; ///< a quarter turn counterclockwise: it reads from below to above
};

} // namespace offstage
