#pragma once

#include "render/draw/picture.h"

#include <array>
#include <cstdint>
#include <optional>

namespace offstage {

/// How the fragment shader computes the part of a pixel that a primitive covers. Each is a program of its
/// own, so that the common ones stay cheap.
enum class Coverage : std::uint8_t {
  Disc,  ///< one circle edge of at least kParabolaRadius
  Ring,  ///< two such edges
  Small, ///< a disc or ring with a smaller edge
  Box,   ///< a rectangle, with or without a rectangular hole
};
inline constexpr std::size_t kCoverageCount = 4;

/// From this radius on, the edge inside a pixel is taken as the parabola that osculates it. Error of the
/// coverage: 1.3/255 at this radius, 0.8/255 at 6 px, 0.5/255 from 12 px on (measured against the exact
/// area).
inline constexpr double kParabolaRadius = 4.0;

/// What the vertex shader reads of one primitive; render/raster/shaders.cpp holds the formulas.
struct Instance {
  std::array<std::uint16_t, 4> quad{};  ///< px: left, top, right, bottom of the pixels to shade
  std::array<std::int16_t, 2> origin{}; ///< px: the point that edges and pattern are expressed from
  std::array<std::uint8_t, 4> color{};  ///< r, g, b, a; not premultiplied
  /// Circles: {n.x, n.y, 1/r, c} with D = origin − centre, n = D/r, c = (|D|² − r²)/(2r), so that
  /// g(p) = c + p·n + |p|²/(2r) is the pixel's distance from the edge to first order (positive outside), with
  /// no large numbers cancelling however large r is. Boxes: {low.x, low.y, high.x, high.y} from the origin.
  std::array<float, 4> outer{};
  std::array<float, 4> inner{};         ///< the hole, in the same form; a box without one has low = high
  std::array<std::int32_t, 4> texels{}; ///< pattern: first texel in the store, width, height, 1 if it repeats
  std::array<float, 4> texelMap{};      ///< pattern: texel coordinate at `origin`, then texels per px
  std::array<float, 2> window{1.0F, 1.0F}; ///< pattern: texels to average along each axis, 1 … 2
};

/// The shape of a primitive made ready: quad, origin, edges and colour are set. Nothing when it touches no
/// pixel of `clip`, which lies inside the canvas.
struct Drawable {
  Instance instance;
  Coverage coverage;
};
std::optional<Drawable> makeDrawable(const Primitive& primitive, const PixelRect& clip);

} // namespace offstage
