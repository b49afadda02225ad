#pragma once

#include "render/raster/frame.h"

#include <cstdint>
#include <vector>

namespace offstage {

/// Encodes a frame as PNG: 8-bit RGB, or RGBA when `alpha`; an sRGB chunk; compressed with libdeflate.
/// `dotsPerMetre` > 0 adds a pHYs chunk. The bytes depend only on the arguments (and libdeflate's version).
std::vector<std::uint8_t> encodePng(const Frame& frame, bool alpha, int dotsPerMetre = 0);

} // namespace offstage
