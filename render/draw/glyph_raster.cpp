#include "render/draw/glyph_raster.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace offstage {
namespace {

constexpr double kTolerance = 0.01; ///< px, of a chord
constexpr int kMostChords = 256;

int chords(double bend) {
  const double wanted = std::ceil(std::sqrt(bend / kTolerance));
  return static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(kMostChords)));
}

/// A curve's chord over a parameter step h is off by at most |second derivative|·h²/8.
void appendCurve(const Vec2& from, const GlyphOutline::Segment& curve, const Vec2& to, Polygon& polygon) {
  const Vec2& a = curve.through[0];
  const Vec2& b = curve.through[1];
  if (curve.controls == 1) {
    const int count = chords(0.25 * length(from - a * 2.0 + to));
    for (int i = 1; i < count; ++i) {
      const double t = static_cast<double>(i) / count;
      const double s = 1.0 - t;
      polygon.emplace_back(from * (s * s) + a * (2.0 * s * t) + to * (t * t));
    }
  } else if (curve.controls == 2) {
    const double bend = std::max(length(from - a * 2.0 + b), length(a - b * 2.0 + to));
    const int count = chords(0.75 * bend);
    for (int i = 1; i < count; ++i) {
      const double t = static_cast<double>(i) / count;
      const double s = 1.0 - t;
      polygon.emplace_back(from * (s * s * s) + a * (3.0 * s * s * t) + b * (3.0 * s * t * t) +
                           to * (t * t * t));
    }
  }
  polygon.push_back(to);
}

std::uint8_t toByte(double share) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 1.0) * 255.0));
}

/// What edges leave in the pixels.
class Accumulator {
public:
  Accumulator(int width, int height) : width_(width), height_(height) {
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    height_of_.resize(pixels);
    area_of_.resize(pixels);
  }

  void addEdge(const Vec2& from, const Vec2& to) {
    if (from.y() == to.y()) return;
    const double sign = from.y() < to.y() ? 1.0 : -1.0;
    const Vec2& top = sign > 0.0 ? from : to;
    const Vec2& bottom = sign > 0.0 ? to : from;
    const double slope = (bottom.x() - top.x()) / (bottom.y() - top.y());
    const int last = std::min(static_cast<int>(std::floor(bottom.y())), height_ - 1);
    for (int row = std::max(static_cast<int>(std::floor(top.y())), 0); row <= last; ++row) {
      const double y0 = std::max(top.y(), static_cast<double>(row));
      const double y1 = std::min(bottom.y(), row + 1.0);
      if (!(y1 > y0)) continue;
      // The ends as given: computed along the slope they could leave the mask by a rounding.
      const double x0 = y0 == top.y() ? top.x() : top.x() + (y0 - top.y()) * slope;
      const double x1 = y1 == bottom.y() ? bottom.x() : top.x() + (y1 - top.y()) * slope;
      addInRow(row, x0, x1, sign * (y1 - y0));
    }
  }

  [[nodiscard]] Mask mask() const {
    Mask mask{width_, height_, {}};
    mask.coverage.reserve(height_of_.size());
    for (int y = 0; y < height_; ++y) {
      double left = 0.0; // the winding height of the edges to the left
      for (int x = 0; x < width_; ++x) {
        const std::size_t i = index(x, y);
        left += height_of_[i];
        mask.coverage.push_back(toByte(std::abs(left - area_of_[i])));
      }
    }
    return mask;
  }

private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  /// An edge within one row, `height` of it in all, cut at the pixels' sides.
  void addInRow(int row, double x0, double x1, double height) {
    const double low = std::min(x0, x1);
    const double high = std::max(x0, x1);
    const int first = std::clamp(static_cast<int>(std::floor(low)), 0, width_ - 1);
    const int last = std::clamp(static_cast<int>(std::floor(high)), 0, width_ - 1);
    if (first == last) {
      addInPixel(first, row, 0.5 * (low + high), height);
      return;
    }
    const double perPixel = height / (high - low);
    for (int column = first; column <= last; ++column) {
      const double left = column == first ? low : column;
      const double right = column == last ? high : column + 1.0;
      addInPixel(column, row, 0.5 * (left + right), (right - left) * perPixel);
    }
  }

  /// `middle`: the mean x of the piece.
  void addInPixel(int column, int row, double middle, double height) {
    const std::size_t i = index(column, row);
    height_of_[i] += height;
    area_of_[i] += height * (middle - column);
  }

  int width_;
  int height_;
  std::vector<double> height_of_; ///< by pixel: signed height of the edges in it
  std::vector<double> area_of_;   ///< by pixel: signed area between its left side and the edges
};

/// Squared distance of a point from a segment.
double squaredDistance(const Vec2& point, const Vec2& from, const Vec2& to) {
  const Vec2 along = to - from;
  const Vec2 d = point - from;
  const double square = dot(along, along);
  const double t = square > 0.0 ? std::clamp(dot(d, along) / square, 0.0, 1.0) : 0.0;
  const Vec2 rest = d - along * t;
  return dot(rest, rest);
}

} // namespace

std::vector<Polygon> flatten(const GlyphOutline& outline, const GlyphPlacement& placement) {
  const auto placed = [&](const Vec2& p) -> Vec2 {
    const Vec2 q = p * placement.scale;
    return placement.upwards ? Vec2(placement.pen.x() - q.y(), placement.pen.y() - q.x())
                             : Vec2(placement.pen.x() + q.x(), placement.pen.y() - q.y());
  };
  std::vector<Polygon> polygons;
  for (const GlyphOutline::Contour& contour : outline.contours) {
    Polygon polygon{placed(contour.start)};
    for (GlyphOutline::Segment segment : contour.segments) {
      for (Vec2& control : segment.through) control = placed(control);
      const Vec2 from = polygon.back();
      appendCurve(from, segment, placed(segment.to), polygon);
    }
    polygons.push_back(std::move(polygon));
  }
  return polygons;
}

Mask fillPolygons(const std::vector<Polygon>& polygons, int width, int height) {
  Accumulator accumulator(width, height);
  for (const Polygon& polygon : polygons) {
    for (std::size_t i = 0; i < polygon.size(); ++i)
      accumulator.addEdge(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return accumulator.mask();
}

Mask outlinePolygons(const std::vector<Polygon>& polygons, const Mask& fill, double reach) {
  const double farthest = (reach + 0.5) * (reach + 0.5);
  std::vector<double> nearest(fill.coverage.size(), farthest); // px²
  for (const Polygon& polygon : polygons) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2& from = polygon[i];
      const Vec2& to = polygon[(i + 1) % polygon.size()];
      const auto first = [&](double a, double b) {
        return std::max(static_cast<int>(std::floor(std::min(a, b) - reach - 1.0)), 0);
      };
      const auto last = [&](double a, double b, int most) {
        return std::min(static_cast<int>(std::ceil(std::max(a, b) + reach + 1.0)), most);
      };
      const int right = last(from.x(), to.x(), fill.width);
      const int bottom = last(from.y(), to.y(), fill.height);
      for (int y = first(from.y(), to.y()); y < bottom; ++y) {
        for (int x = first(from.x(), to.x()); x < right; ++x) {
          double& best = nearest[static_cast<std::size_t>(y) * static_cast<std::size_t>(fill.width) +
                                 static_cast<std::size_t>(x)];
          best = std::min(best, squaredDistance(Vec2(x + 0.5, y + 0.5), from, to));
        }
      }
    }
  }
  Mask mask{fill.width, fill.height, {}};
  mask.coverage.reserve(fill.coverage.size());
  for (std::size_t i = 0; i < nearest.size(); ++i)
    mask.coverage.push_back(std::max(fill.coverage[i], toByte(reach + 0.5 - std::sqrt(nearest[i]))));
  return mask;
}

} // namespace offstage
