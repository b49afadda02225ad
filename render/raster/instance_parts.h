#pragma once

#include "render/raster/instance.h"

namespace offstage {

/// The pixels that low…high touches inside `clip`; none when a coordinate is NaN.
PixelRect touchedPixels(const Vec2& low, const Vec2& high, const PixelRect& clip);

/// Sets what every kind has alike: the pixels to shade, which `bounds` holds, the footprint and the colour.
void finish(const Primitive& primitive, const PixelRect& bounds, const PixelRect& clip, int largestPoint,
            Drawable& drawable);

/// makeDrawable() for Quad, Arrow, Strip and Elbow.
std::optional<Drawable> makePathDrawable(const Primitive& primitive, const PixelRect& clip, int largestPoint);

} // namespace offstage
