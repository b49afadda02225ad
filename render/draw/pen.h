#pragma once

#include "render/draw/picture.h"

#include <span>
#include <vector>

namespace offstage {

/// Which ends of a path are round; the others are cut off at right angles, which costs less to draw.
struct PathEnds {
  bool roundFirst = true;
  bool roundLast = true;
};

/// Draws lines into a picture. Everything is in output px. What has a coordinate that is not finite, or lies
/// farther than 32768 px from the picture's corner, is left out.
class Pen {
public:
  /// `width` ≥ 0. `clip`: index into Picture::clips, or −1.
  Pen(Picture& picture, double width, Rgba8 color, std::int32_t clip = -1)
      : picture_(picture), width_(width), color_(color), clip_(clip) {}

  void setColor(Rgba8 color) { color_ = color; }

  /// A straight line with square ends.
  void line(const Vec2& from, const Vec2& to);
  /// Dashes of `dash` px and gaps of `gap` px, beginning and ending with half a dash or more. Both > 0.
  void dashes(const Vec2& from, const Vec2& to, double dash, double gap);
  /// A circle's line of this pen's width, its middle `radius` from the centre.
  void circle(const Vec2& center, double radius);
  void disc(const Vec2& center, double radius);
  void rectangle(const Vec2& low, const Vec2& high); ///< filled
  /// An arrow with its tip at `to`; the head is `head` px long and as wide, and never longer than the arrow.
  /// Drawn as one shape, so that a translucent one is evenly so.
  void arrow(const Vec2& from, const Vec2& to, double head);
  /// A path with round corners. Also a translucent one is of one colour where its pieces meet; only where it
  /// crosses itself it shows twice. `colors`: one for each pair of points, or none: the pen's own. What is
  /// drawn of a smooth piece depends on what comes before it, not on what comes after: a path that grows
  /// keeps it.
  void path(std::span<const Vec2> points, std::span<const Rgba8> colors = {}, PathEnds ends = {});

private:
  void add(Primitive primitive, Rgba8 color);

  Picture& picture_;
  double width_;
  Rgba8 color_;
  std::int32_t clip_;
};

/// The colour with its alpha multiplied by `part` (0 … 1), rounded down.
Rgba8 faded(Rgba8 color, double part);

} // namespace offstage
