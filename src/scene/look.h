#pragma once

#include "src/scene/color.h"
#include "src/scene/diagnostic.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

namespace offstage {

/// An image as a fill: JavaFX's ImagePattern(image, x, y, width, height, proportional). The anchor rectangle
/// holds one copy of the image, which repeats in both directions from there.
struct ImagePattern {
  std::filesystem::path file;                       ///< PNG, JPEG or BMP
  std::array<double, 4> anchor{0.0, 0.0, 1.0, 1.0}; ///< x, y, width > 0, height > 0
  /// true: anchor in fractions of the shape's bounding box (the stroke not counted); the default stretches
  /// the image once over it. false: anchor in the pane's pixels; the pattern stays while the shape moves.
  bool proportional = true;
  SourceLocation where; ///< of the scene's key, for errors in the image; empty from C++
};

using Paint = std::variant<Color, ImagePattern>;

enum class StrokeAlign : std::uint8_t { Centered, Inside, Outside };

/// An outline.
struct Stroke {
  Paint paint = Color{};
  double width = 1.0; ///< px, ≥ 0
  StrokeAlign align = StrokeAlign::Centered;
};

/// How a shape is painted. JavaFX's defaults: black fill, no stroke.
struct Look {
  std::optional<Paint> fill = Color{};
  std::optional<Stroke> stroke;
  double opacity = 1.0; ///< 0 … 1, multiplies every alpha of the shape
};

} // namespace offstage
