#pragma once

#include "render/draw/picture.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace offstage {

/// What a primitive does to a rectangle of pixels.
enum class Cover : std::uint8_t {
  None,  ///< covers no part of any of its pixels
  Some,  ///< may cover some of it
  Whole, ///< covers every pixel of it wholly
};

/// Tells for one primitive. Sure in None and Whole; near an edge, and for circles whose edge is nearly
/// straight, it says Some.
class CoverTest {
public:
  explicit CoverTest(const Primitive& primitive);

  [[nodiscard]] Cover of(const PixelRect& rect) const {
    if (outline_ == Outline::Circle) return ofCircle(rect);
    return outline_ == Outline::Box ? ofBox(rect) : ofPath(rect);
  }

private:
  enum class Outline : std::uint8_t { Circle, Box, Path };

  /// A rectangle that is open at its edges.
  struct Bounds {
    double left, top, right, bottom; ///< px

    [[nodiscard]] bool touches(const PixelRect& rect) const {
      return rect.right > left && rect.left < right && rect.bottom > top && rect.top < bottom;
    }
    [[nodiscard]] bool holds(const PixelRect& rect) const {
      return rect.left >= left && rect.right <= right && rect.top >= top && rect.bottom <= bottom;
    }
  };
  static Bounds nowhere();
  static Bounds boundsOf(const Vec2& low, const Vec2& high, double grown);

  [[nodiscard]] Cover ofCircle(const PixelRect& rect) const {
    const double left = rect.left - x_;
    const double right = rect.right - x_;
    const double top = rect.top - y_;
    const double bottom = rect.bottom - y_;
    const double nearX = std::max({left, -right, 0.0});
    const double nearY = std::max({top, -bottom, 0.0});
    const double nearest = nearX * nearX + nearY * nearY; // squared distances from the centre
    if (nearest > outside_) return Cover::None;
    const double farX = std::max(-left, right);
    const double farY = std::max(-top, bottom);
    const double farthest = farX * farX + farY * farY;
    if (farthest < hole_) return Cover::None;
    return farthest < inside_ && nearest > rim_ ? Cover::Whole : Cover::Some;
  }

  [[nodiscard]] Cover ofBox(const PixelRect& rect) const {
    if (!boxOutside_.touches(rect)) return Cover::None;
    if (holed_ && boxHole_.holds(rect)) return Cover::None;
    return boxInside_.holds(rect) && !(holed_ && boxRim_.touches(rect)) ? Cover::Whole : Cover::Some;
  }

  /// Of paths and polygons only None is told: they are thin, and seldom hide anything.
  [[nodiscard]] Cover ofPath(const PixelRect& rect) const;
  void setPath(const Primitive& primitive);
  void setEdges(const Primitive& quad);
  void addBand(const Vec2& from, const Vec2& to, double across, double past);

  Outline outline_ = Outline::Box;
  double x_ = 0.0, y_ = 0.0; ///< px: a circle's centre
  double outside_ = 0.0;     ///< px²: farther than this there is nothing of the circle
  double inside_ = 0.0;      ///< px²: nearer than this, it has no outer edge
  double rim_ = -1.0;        ///< px²: farther than this, it has no inner edge
  double hole_ = 0.0;        ///< px²: nearer than this is its hole
  bool holed_ = false;       ///< the box has a hole
  Bounds boxOutside_{}, boxInside_{}, boxRim_{}, boxHole_{};
  /// A straight band around a line: it reaches `across` px to either side and `past` px past the line's ends.
  struct Band {
    Vec2 from, ahead;
    double length, across, past;
  };
  /// A line along an edge of a quadrilateral: outside of it a point has normal·point > offset.
  struct Edge {
    Vec2 normal;
    double offset;
  };
  // A path or an arrow lies inside its bands, a quadrilateral inside its edges and boxOutside_.
  std::array<Band, 2> bands_{};
  std::size_t bandCount_ = 0;
  std::array<Edge, 4> edges_{};
  std::size_t edgeCount_ = 0;
};

/// True when the primitive hides what is below it wherever it covers a pixel wholly, and looks the same in
/// all of these pixels.
inline bool isPlain(const Primitive& primitive) {
  return primitive.pattern < 0 && primitive.color.a == 255;
}

} // namespace offstage
