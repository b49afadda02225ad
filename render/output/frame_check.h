#pragma once

#include "render/raster/frame.h"

namespace offstage {

/// Throws Error(BadInput) unless the frame has at least one pixel and its buffer holds exactly its pixels.
void requireWholeFrame(const Frame& frame);

/// The same, and the size must be width × height: what every sink asks of each frame.
void requireFrameSize(const Frame& frame, int width, int height);

} // namespace offstage
