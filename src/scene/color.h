#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace offstage {

/// A colour in sRGB, not premultiplied.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  double alpha = 1.0; ///< 0 … 1

  /// From components 0 … 1, as JavaFX's Color.color: floor(255*c), so 0.5 is 127. Out of range is clamped.
  static Color unit(double red, double green, double blue, double alpha = 1.0);
  /// From integers 0 … 255.
  static constexpr Color rgb(std::uint8_t red, std::uint8_t green, std::uint8_t blue, double alpha = 1.0) {
    return {red, green, blue, alpha};
  }

  /// alpha times a node's opacity as the byte that is drawn with: floor(255*(alpha*opacity)), as JavaFX does.
  [[nodiscard]] std::uint8_t alphaByte(double opacity = 1.0) const;

  friend bool operator==(const Color&, const Color&) = default;
};

/// "white" (CSS Color Module Level 4 names, any case), "transparent", "#rgb", "#rrggbb", "#rrggbbaa".
/// Nothing when the text is none of these.
std::optional<Color> parseColor(std::string_view text);

/// The colour name nearest to a typo, or an empty view when none is near.
std::string_view nearestColorName(std::string_view text);

} // namespace offstage
