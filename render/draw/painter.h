#pragma once

#include "render/draw/picture.h"
#include "src/scene/look.h"
#include "src/sim/body.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace offstage {

/// Turns shapes with looks into a Picture's primitives: a fill, then a stroke over it, as JavaFX paints a
/// node. Bad geometry (NaN, infinite, negative) paints nothing.
class Painter {
public:
  explicit Painter(Viewport viewport, Color background);

  /// A look made ready once: colours as bytes, images decoded. Indices count from 0. Throws as loadImage().
  std::uint32_t addLook(const Look& look);
  /// Puts another look in the place of one that was added. Throws as loadImage().
  void setLook(std::uint32_t index, const Look& look);

  void begin(Picture& picture) const; ///< empties the picture and sets its size and background
  // `opacity`: 0 … 1, multiplies that of the look.
  void circle(Picture& picture, const Vec2& center, double radius, std::uint32_t look,
              double opacity = 1.0) const;
  void rectangle(Picture& picture, const Vec2& position, const Vec2& size, std::uint32_t look,
                 double opacity = 1.0) const;
  void body(Picture& picture, const Body& body, std::uint32_t look, double opacity = 1.0) const;

  /// The colour that stands for a look where only one can be shown, in a trail or a legend: of its fill, or
  /// else of its stroke, opaque; of images and without either black on light backgrounds, white on dark ones.
  [[nodiscard]] Rgba8 colorOf(std::uint32_t look) const;

  /// A layer of one colour over all that is painted so far, within the viewport's clip.
  void veil(Picture& picture, Rgba8 color) const;
  /// The same under all that is painted so far.
  void ground(Picture& picture, Rgba8 color) const;

  [[nodiscard]] const Viewport& viewport() const { return viewport_; }
  /// Where shapes are painted from now on; the picture's size and clip must stay the same.
  void setViewport(const Viewport& viewport) { viewport_ = viewport; }

private:
  struct PreparedPaint {
    Rgba8 color;
    std::shared_ptr<const Image> image; ///< null: colour only
    std::array<double, 4> anchor{};
    bool proportional = true;
  };
  struct PreparedLook {
    std::optional<PreparedPaint> fill;
    std::optional<PreparedPaint> stroke;
    double strokeWidth = 0.0; ///< scene px
    StrokeAlign strokeAlign = StrokeAlign::Centered;
  };
  /// A shape's bounding box without its stroke, output px: what proportional patterns are fitted to.
  struct Bounds {
    Vec2 low;
    Vec2 high;
  };

  [[nodiscard]] Primitive layer(Rgba8 color) const; ///< all of the clip
  PreparedLook prepare(const Look& look);
  PreparedPaint prepare(const Paint& paint, double opacity);
  /// How a shape is painted with one of its two paints.
  struct Coat {
    const PreparedPaint& paint;
    double opacity;
    bool isStroke;
  };
  void add(Picture& picture, Primitive& primitive, const Bounds& bounds, const Coat& coat) const;
  Viewport viewport_;
  Rgba8 background_;
  ImageCache images_;
  std::vector<PreparedLook> looks_;
};

} // namespace offstage
