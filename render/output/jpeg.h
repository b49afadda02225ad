#pragma once

#include "render/raster/frame.h"

#include <cstdint>
#include <vector>

namespace offstage {

/// Encodes a frame as JPEG (ISO/IEC 10918-1, baseline, quality 92, colour at full resolution); alpha is left
/// out. The bytes depend only on the pixels.
std::vector<std::uint8_t> encodeJpeg(const Frame& frame);

} // namespace offstage
