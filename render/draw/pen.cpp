#include "render/draw/pen.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace offstage {
namespace {

constexpr double kFarthest = 32768.0;   ///< px
constexpr double kMostDashes = 10000.0; ///< more are grey

bool near(const Vec2& point) { // false for NaN
  return std::abs(point.x()) <= kFarthest && std::abs(point.y()) <= kFarthest;
}

} // namespace

Rgba8 faded(Rgba8 color, double part) {
  color.a = static_cast<std::uint8_t>(std::clamp(part, 0.0, 1.0) * color.a);
  return color;
}

void Pen::add(Primitive primitive, Rgba8 color) {
  if (color.a == 0) return;
  primitive.color = color;
  primitive.clip = clip_;
  picture_.primitives.push_back(primitive);
}

void Pen::line(const Vec2& from, const Vec2& to) {
  if (!near(from) || !near(to) || from == to) return;
  Primitive primitive;
  const double half = 0.5 * width_;
  if (from.x() == to.x() || from.y() == to.y()) { // a box costs least
    const Vec2 reach = from.x() == to.x() ? Vec2(half, 0.0) : Vec2(0.0, half);
    primitive.kind = Primitive::Kind::Box;
    primitive.low = from.cwiseMin(to) - reach;
    primitive.high = from.cwiseMax(to) + reach;
  } else {
    const Vec2 along = to - from;
    const Vec2 aside = Vec2(-along.y(), along.x()) * (half / length(along));
    primitive.kind = Primitive::Kind::Quad;
    primitive.low = from - aside;
    primitive.high = to - aside;
    primitive.innerLow = to + aside;
    primitive.innerHigh = from + aside;
  }
  add(primitive, color_);
}

void Pen::dashes(const Vec2& from, const Vec2& to, double dash, double gap) {
  if (!near(from) || !near(to) || from == to) return;
  const Vec2 along = to - from;
  const double whole = length(along);
  const double period = dash + gap;
  // A whole number of periods that end in the middle of dashes at both ends, the period stretched to fit.
  const double periods = std::max(std::round(whole / period), 1.0);
  if (periods > kMostDashes) return line(from, to);
  const double step = whole / periods;
  const double half = 0.5 * std::min(dash, step);
  for (int i = 0; i <= static_cast<int>(periods); ++i) {
    const double first = std::max(i * step - half, 0.0) / whole;
    const double last = std::min(i * step + half, whole) / whole;
    line(from + along * first, from + along * last);
  }
}

void Pen::circle(const Vec2& center, double radius) {
  if (!near(center) || !(radius >= 0.0 && radius < kFarthest)) return;
  Primitive primitive;
  primitive.kind = Primitive::Kind::Ring;
  primitive.center = center;
  primitive.outer = radius + 0.5 * width_;
  primitive.inner = std::max(radius - 0.5 * width_, 0.0);
  add(primitive, color_);
}

void Pen::disc(const Vec2& center, double radius) {
  if (!near(center) || !(radius > 0.0 && radius < kFarthest)) return;
  Primitive primitive;
  primitive.kind = Primitive::Kind::Disc;
  primitive.center = center;
  primitive.outer = radius;
  add(primitive, color_);
}

void Pen::rectangle(const Vec2& low, const Vec2& high) {
  if (!near(low) || !near(high)) return;
  Primitive primitive;
  primitive.kind = Primitive::Kind::Box;
  primitive.low = low;
  primitive.high = high;
  add(primitive, color_);
}

void Pen::arrow(const Vec2& from, const Vec2& to, double head) {
  if (!near(from) || !near(to) || from == to) return;
  const double whole = length(to - from);
  const double size = std::min(head, whole);
  Primitive primitive;
  primitive.kind = Primitive::Kind::Arrow;
  primitive.low = from;
  primitive.high = to;
  primitive.outer = 0.5 * width_;
  primitive.innerLow = Vec2(size, std::max(0.5 * size, 0.5 * width_));
  add(primitive, color_);
}

} // namespace offstage
