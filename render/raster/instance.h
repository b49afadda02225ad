#pragma once

#include "render/draw/picture.h"

#include <array>
#include <cstdint>
#include <optional>

namespace offstage {

/// How the fragment shader computes the part of a pixel that a primitive covers. Each is a program of its
/// own, so that the common ones stay cheap.
enum class Coverage : std::uint8_t {
  Disc,         ///< a circle of kLeastArcRadius to kMostArcRadius
  Ring,         ///< two such circles
  LargeCircle,  ///< a disc or ring of kLeastArcRadius or more
  AnyCircle,    ///< a disc or ring of any radii
  Box,          ///< a rectangle, with or without a rectangular hole
  Quad,         ///< a polygon of four corners
  Arrow,        ///< a polygon of seven corners
  Strip,        ///< a straight piece of a path
  Elbow,        ///< a bent or round-ended piece of a path
  DiscOnGround, ///< a Disc laid over one known opaque colour, which it replaces without blending
  Whole, ///< every pixel wholly: what was there is replaced by Instance::color as it is, without blending
  Mask,  ///< a texel of the store a pixel
};
inline constexpr std::size_t kCoverageCount = 12;

/// From this radius on, the edge inside a pixel is taken as the parabola that osculates it, and integrated
/// over four columns. Measured error against the exact area: at most 2.5/255.
inline constexpr double kLeastArcRadius = 5.0;

/// Up to this radius, floats from the circle's centre are precise enough (1e-4 px).
inline constexpr double kMostArcRadius = 1024.0;

/// What GL draws for an instance. A point costs llvmpipe two thirds of a quad, but is square.
enum class Footprint : std::uint8_t { Point, Quad };
inline constexpr std::size_t kFootprintCount = 2;

/// What the vertex shader reads of one primitive; render/raster/shaders.cpp holds the formulas.
struct Instance {
  /// px: left, top, right, bottom of the pixels to shade; all 0: nothing is drawn. Square for a point.
  std::array<std::uint16_t, 4> quad{};
  std::array<std::int16_t, 2> origin{}; ///< px: the point that edges and pattern are expressed from
  std::array<std::uint8_t, 4> color{};  ///< r, g, b, a; not premultiplied
  /// Disc, Ring: {centre.x, centre.y, r², 0}, from the frame's upper-left corner: half of a float's last
  /// digit is at most 0.0005 px there. With D = origin − centre, LargeCircle, AnyCircle: {n.x, n.y, 1/r, c}
  /// with n = D/r, c = (|D|² − r²)/(2r), so that g(p) = c + p·n + |p|²/(2r) is a pixel's distance from the
  /// edge to first order (positive outside), with no large numbers cancelling however large r is; Box:
  /// {low.x, low.y, high.x, high.y} from the origin. Quad, Arrow: two corners from the origin; the further
  /// ones in `inner`, `texelMap` and `window`. Strip: {n.x, n.y, c, half width}: n·p + c is the distance from
  /// the line's middle, p from the frame's upper-left corner. Elbow: {from, corner} from the origin, x and y
  /// exchanged where inner[3] is 1.
  std::array<float, 4> outer{};
  /// The hole, in the same form; a box without one has low = high. DiscOnGround: groundOf() in
  /// render/raster/ground_check.h. Elbow: {to, half width, 1 if x and y are exchanged}.
  std::array<float, 4> inner{};
  /// pattern: first texel in the store, width, height, 1 if it repeats; mask: first texel, width, height, 0
  std::array<std::int32_t, 4> texels{};
  /// Pattern: texel coordinate at `origin`, then texels per px. Strip, Elbow: the first cut {n.x, n.y, c},
  /// then the second one's n.x: a pixel's centre p is in front of a cut where n.x·p.x + n.y·p.y + c ≥ 0.
  std::array<float, 4> texelMap{};
  std::array<float, 2> window{1.0F, 1.0F}; ///< pattern: texels to average along each axis, 1 … 2
};

/// A primitive made ready: quad, origin, edges and colour of the instance are set.
struct Drawable {
  Instance instance;
  Coverage coverage;
  Footprint footprint;
};

/// Nothing when the primitive touches no pixel of `clip`, which lies inside the canvas. `largestPoint` is the
/// side of GL's largest point in px.
std::optional<Drawable> makeDrawable(const Primitive& primitive, const PixelRect& clip, int largestPoint);

} // namespace offstage
