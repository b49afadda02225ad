#pragma once

#include "render/draw/picture.h"
#include "render/raster/frame.h"

namespace offstage::test {

/// An empty picture of width×height px.
Picture blankPicture(int width, int height, Rgba8 background = {255, 255, 255, 255});

Primitive disc(double x, double y, double radius, Rgba8 color);
Primitive ring(double x, double y, double inner, double outer, Rgba8 color);
Primitive box(double left, double top, double right, double bottom, Rgba8 color);

/// Appends a box that shows the image once (or tiled from its upper-left corner, each tile size px).
void addPatternBox(Picture& picture, const std::shared_ptr<const Image>& image, const Vec2& low,
                   const Vec2& high, const Vec2& tile, bool repeat, std::uint8_t alpha = 255);

/// An image whose texels all differ, with alpha if asked.
std::shared_ptr<const Image> colorfulImage(int width, int height, bool alpha);

/// Draws with a canvas of its own.
Frame drawOnce(const Picture& picture);

Rgba8 pixel(const Frame& frame, int x, int y);

/// Appends lines, arrows and paths of every kind, some of them clipped, to a picture of at least 333×217 px.
void addEveryLine(Picture& picture);

/// A picture that uses every program of the canvas, with fractional positions, tiny and huge radii, overlaps,
/// translucency and image patterns at many scales.
Picture everythingPicture();

} // namespace offstage::test
