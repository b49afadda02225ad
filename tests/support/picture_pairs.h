#pragma once

#include "render/raster/frame.h"

#include <cstdint>
#include <utility>

namespace offstage::test {

/// Pair `number` of pictures that tests/reference/pixelmatch/make_counts.mjs makes alike: discs that moved,
/// changed colour or are missing, noise, lines, translucent ones.
std::pair<Frame, Frame> picturePair(int number);

/// FNV-1a of 32 bits over the pixels.
std::uint32_t pictureHash(const Frame& frame);

} // namespace offstage::test
