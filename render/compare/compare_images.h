#pragma once

#include "render/compare/comparison.h"
#include "render/raster/frame.h"

namespace offstage {

/// Compares two frames. Frames of different sizes are a result (Kind::SizeDiffers), not an error. Throws
/// Error(BadInput) when a frame is empty or a mask cannot be read or has another size.
Comparison compareImages(const Frame& expected, const Frame& actual, const Tolerance& tolerance,
                         Metrics metrics = Metrics::Fast);

/// expected | difference | actual, side by side with a margin: what `--strip` writes. In the difference
/// unequal pixels stand in their severity's colour over the paled expected picture, forgiven ones in yellow.
Frame makeStrip(const Frame& expected, const Frame& actual, const Tolerance& tolerance);

/// The middle of the strip alone, of the expected picture's size (of the larger where sizes differ).
Frame makeDifferencePicture(const Frame& expected, const Frame& actual, const Tolerance& tolerance);

} // namespace offstage
