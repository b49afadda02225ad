#pragma once

#include "render/compare/row_window.h"
#include "render/draw/pixel_rows.h"

#include <cstdint>

namespace offstage {

// The measure of npm's pixelmatch 7.2.0 (ISC licence, Mapbox), with equal numbers.
//
// The distance of two colours is that of Kotsarenko and Ramos, "Measuring perceived color difference using
// YIQ NTSC transmission color space in mobile applications" (2010); pixels that are not opaque are blended
// over a pattern of colours that depends on their place. Whether a pixel belongs to an antialiased edge is
// decided after Vysniauskas, "Anti-aliased Pixel and Intensity Slope Detector" (2009): it has at most two
// neighbours of its own brightness, both darker and brighter ones, and its darkest or its brightest neighbour
// lies in a flat part of both pictures.

/// pixelmatch's counts of two pictures of equal size, of 8 bits a channel, at its default threshold of 0.1.
struct PixelmatchCounts {
  std::int64_t differing = 0; ///< includeAA false: without those that look antialiased in either picture
  std::int64_t withAa = 0;    ///< includeAA true
};
PixelmatchCounts pixelmatch(const PixelRows& a, const PixelRows& b, int threads);

/// Whether pixel x of the windows' row looks antialiased in the first picture, the second being the one that
/// it is compared with. Both windows must stand at the same row.
bool looksAntialiased(const RowWindow& in, const RowWindow& other, int x);

} // namespace offstage
