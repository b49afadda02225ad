#pragma once

#include "render/draw/image.h"
#include "render/draw/mask.h"
#include "src/sim/vec.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace offstage {

/// A colour ready to be drawn with: sRGB bytes, alpha not premultiplied, opacity already in it.
struct Rgba8 {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;
  friend bool operator==(const Rgba8&, const Rgba8&) = default;
};

/// A rectangle of whole pixels, from left, top up to but without right, bottom.
struct PixelRect {
  int left = 0, top = 0, right = 0, bottom = 0;
  [[nodiscard]] bool empty() const { return left >= right || top >= bottom; }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

/// How pixels become those of the output: output = scene*scale + offset.
struct Viewport {
  int width = 640;  ///< output px
  int height = 480; ///< output px
  double scale = 1.0;
  Vec2 offset = Vec2::Zero();     ///< output px: where the pane's upper-left corner is
  PixelRect clip{0, 0, 640, 480}; ///< output px: the pane; nothing is painted outside it

  /// The pane at `scale`: size rounded to whole pixels, at least 1×1.
  static Viewport scaled(double paneWidth, double paneHeight, double scale);
  /// The pane as large as fits into width×height, centred; the rest shows the background.
  static Viewport fitted(double paneWidth, double paneHeight, int width, int height);
};

/// An image pattern placed on the output: one copy of the image fills `origin … origin + size`, and repeats
/// if asked.
struct PlacedPattern {
  std::shared_ptr<const Image> image;
  Vec2 origin = Vec2::Zero(); ///< output px
  Vec2 size = Vec2::Zero();   ///< output px, > 0
  /// false: the image is stretched once over the shape and its outermost texels extend beyond; true: it
  /// tiles.
  bool repeat = false;
  friend bool operator==(const PlacedPattern&, const PlacedPattern&) = default;
};

/// One thing to paint. Coordinates are output pixels, y down, the upper-left pixel's centre at (0.5, 0.5).
/// Doubles up to here.
struct Primitive {
  enum class Kind : std::uint8_t {
    Disc,    ///< |p − center| < outer
    Ring,    ///< inner < |p − center| < outer
    Box,     ///< low < p < high
    BoxRing, ///< inside low…high and not inside innerLow…innerHigh
    Mask,    ///< a mask at whole pixels: low its upper-left corner, high − low its size
    Quad,    ///< the convex quadrilateral low, high, innerLow, innerHigh; a triangle repeats a corner
    /// From low to high: a shaft of half the width `outer`, then a triangular head, innerLow.x long and of
    /// half the width innerLow.y. With a head as long as the whole, a triangle.
    Arrow,
    /// Nearer than outer to the line through low and high: a straight piece of a path. A pixel belongs to it
    /// when its centre lies in front of the cut through low and not in front of the cut through high, so that
    /// neighbouring pieces share no pixel and leave none out. innerLow, innerHigh: the cuts' normals along
    /// the path.
    Strip,
    /// Nearer than outer to the path low, center, high: a corner of a path, or with center = high one
    /// straight line. With a normal in innerLow, innerHigh it is cut there as a Strip is; without (zero) it
    /// ends round.
    Elbow,
  };
  Kind kind = Kind::Disc;
  Rgba8 color;               ///< with a pattern, only .a is used: it multiplies the image's alpha
  std::int32_t pattern = -1; ///< index into Picture::patterns, or −1; of the kinds up to BoxRing only
  std::int32_t mask = -1;    ///< of a Mask: index into Picture::masks
  std::int32_t clip = -1;    ///< index into Picture::clips, or −1: Picture::clip holds alone
  Vec2 center = Vec2::Zero();
  double outer = 0.0; ///< ≥ 0
  double inner = 0.0; ///< 0 … outer
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  Vec2 innerLow = Vec2::Zero(), innerHigh = Vec2::Zero();
};

/// A frame's display list: what is painted, in this order, over the background. Once handed to a canvas it is
/// not changed.
struct Picture {
  int width = 0;  ///< px
  int height = 0; ///< px
  Rgba8 background{255, 255, 255, 255};
  /// Primitives are painted only inside it, the background everywhere. By default all of the picture.
  PixelRect clip{0, 0, std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
  std::vector<Primitive> primitives;
  std::vector<PlacedPattern> patterns;
  std::vector<PixelRect> clips;                   ///< narrower ones, for single primitives: panels, plots
  std::vector<std::shared_ptr<const Mask>> masks; ///< known by their address: the same mask, the same object

  void clear() {
    primitives.clear();
    patterns.clear();
    clips.clear();
    masks.clear();
  } ///< keeps the memory for the next frame
};

} // namespace offstage
