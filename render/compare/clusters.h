#pragma once

#include "render/compare/bit_plane.h"
#include "render/draw/picture.h"

#include <cstdint>

namespace offstage {

/// Groups of set bits that touch each other, corners too.
struct Clusters {
  std::int64_t count = 0;
  std::int64_t pixels = 0;  ///< all set bits
  std::int64_t largest = 0; ///< px of the largest group; the first in reading order among equals
  PixelRect largestBox;
  PixelRect box; ///< around all of them
};

/// Memory is that of two rows, whatever the picture: groups are closed as soon as a row has none of their
/// pixels.
Clusters findClusters(const BitPlane& plane, int width, int height);

} // namespace offstage
