#include "render/draw/plot_painter.h"

#include "render/draw/fit_text.h"
#include "render/draw/pen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace offstage {
namespace {

constexpr double kTolerance = 0.1; ///< px that a curve may lie beside its points
constexpr double kDisc = 1.8;      ///< the present's radius, in widths of the curve
constexpr int kLeastTicks = 2;     ///< that an axis is asked for
constexpr double kBetween = 0.5;   ///< em between the numbers of neighbouring ticks
constexpr double kLeastAxes = 0.2; ///< of the area's height, where a legend stands above
/// Of a legend's names, in sizes of the plot's texts: the first with which it has room.
constexpr std::array kLegendSizes{1.0, 0.85, 0.7};

Rgba8 bytes(const Color& color) {
  return {color.red, color.green, color.blue, color.alphaByte()};
}

/// px: the middle of a line of whole pixels' width, where it is sharp.
double sharp(double at, double width) {
  return std::round(at - 0.5 * width) + 0.5 * width;
}

struct Extent {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -std::numeric_limits<double>::infinity();

  void add(double value, bool log) {
    if (!std::isfinite(value) || (log && !(value > 0.0))) return;
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
};

/// Whether a line goes through a rectangle. (Liang and Barsky, A new concept and method for line clipping,
/// 1984.)
bool crosses(const Vec2& from, const Vec2& to, const Vec2& low, const Vec2& high) {
  double enters = 0.0;
  double leaves = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double along = to[axis] - from[axis];
    if (along == 0.0) {
      if (from[axis] < low[axis] || from[axis] > high[axis]) return false;
      continue;
    }
    const double one = (low[axis] - from[axis]) / along;
    const double other = (high[axis] - from[axis]) / along;
    enters = std::max(enters, std::min(one, other));
    leaves = std::min(leaves, std::max(one, other));
  }
  return enters <= leaves;
}

/// Up to rounding. Not: what is nowhere.
bool isWithin(const Vec2& at, const Vec2& low, const Vec2& high) {
  const Vec2 slack = Vec2::Constant(1e-6);
  return (at.array() >= (low - slack).array()).all() && (at.array() <= (high + slack).array()).all();
}

} // namespace

void append(Picture& picture, const Picture& part) {
  const auto patterns = static_cast<std::int32_t>(picture.patterns.size());
  const auto masks = static_cast<std::int32_t>(picture.masks.size());
  const auto clips = static_cast<std::int32_t>(picture.clips.size());
  for (Primitive primitive : part.primitives) {
    if (primitive.pattern >= 0) primitive.pattern += patterns;
    if (primitive.mask >= 0) primitive.mask += masks;
    if (primitive.clip >= 0) primitive.clip += clips;
    picture.primitives.push_back(primitive);
  }
  picture.patterns.insert(picture.patterns.end(), part.patterns.begin(), part.patterns.end());
  picture.masks.insert(picture.masks.end(), part.masks.begin(), part.masks.end());
  picture.clips.insert(picture.clips.end(), part.clips.begin(), part.clips.end());
}

PlotPainter::PlotPainter(const Plot& plot, std::vector<const PlotData::Points*> curves,
                         const Viewport& viewport, const TextPainter& texts)
    : plot_(plot),
      curves_(std::move(curves)),
      viewport_(viewport),
      texts_(texts),
      legend_(plot, viewport, texts) {
  makeAxes();
  layOut();
  if (plot_.legend) placeLegend();
  drawFrame(still_);
  grown_.assign(plot_.curves.size(), Grown{.open = PathSimplifier(kTolerance)});
}

void PlotPainter::makeAxes() {
  Extent x;
  Extent y;
  for (const PlotData::Points* points : curves_) {
    for (const PlotData::Point& point : *points) {
      x.add(point.x, plot_.x.log);
      y.add(point.y, plot_.y.log);
    }
  }
  // About one tick for every six letters' width, and every two lines' height.
  columns_ = std::max(static_cast<int>(plot_.area[2] / (5.0 * plot_.textSize)), kLeastTicks);
  const int rows =
      std::max(static_cast<int>((plot_.area[3] - legendHeight_) / (2.6 * plot_.textSize)), kLeastTicks);
  const auto make = [](const PlotAxis& axis, const Extent& extent, int most) {
    if (axis.range) return Axis((*axis.range)[0], (*axis.range)[1], axis.log);
    return Axis::around(extent.least, extent.greatest, axis.log, most);
  };
  x_ = make(plot_.x, x, columns_);
  y_ = make(plot_.y, y, rows);
  xTicks_ = x_.ticks(columns_);
  yTicks_ = y_.ticks(rows);
}

TextLook PlotPainter::textLook(NinePosition anchor, double size) const {
  TextLook look;
  look.size = size;
  look.color = plot_.ink;
  look.anchor = anchor;
  return look;
}

void PlotPainter::text(Picture& picture, const std::string& text, const Vec2& outputPoint,
                       NinePosition anchor, double size) const {
  if (text.empty()) return;
  texts_.draw(picture, text, textLook(anchor, size), (outputPoint - viewport_.offset) / viewport_.scale);
}

/// In a corner that no curve goes through in the whole run, so that it stands still and hides nothing; where
/// there is none, in rows of its own above the axes. Where these would take too much of a small plot, the
/// same with smaller names; where nothing helps, it is left out, for curves are what a plot is there for.
void PlotPainter::placeLegend() {
  for (const double size : kLegendSizes) {
    legend_.setSize(size * plot_.textSize);
    if (toFreeCorner() || toRows()) return;
  }
  legend_.leaveOut();
}

bool PlotPainter::toFreeCorner() {
  const auto crossing = [this](const Vec2& low, const Vec2& high) { return pointsIn(low, high); };
  return legend_.toFreeCorner(inner_.low, inner_.high, crossing);
}

/// False where they would leave too little of the axes.
bool PlotPainter::toRows() {
  const double em = plot_.textSize * viewport_.scale;
  const double left = plot_.area[0] * viewport_.scale + viewport_.offset.x();
  const double top = plot_.area[1] * viewport_.scale + viewport_.offset.y();
  const double right = left + plot_.area[2] * viewport_.scale;
  const auto place = [&] {
    return legend_.toRows(left + 0.6 * em, right - 0.6 * em, 0.5 * (inner_.low.x() + inner_.high.x()),
                          top + (plot_.title.empty() ? 0.35 : 2.0) * em);
  };
  const double height = place() / viewport_.scale;
  if (height + kLeastAxes * plot_.area[3] > (inner_.high.y() - inner_.low.y()) / viewport_.scale)
    return false;
  legendHeight_ = height;
  makeAxes(); // fewer ticks
  layOut();
  static_cast<void>(place()); // the middle of these axes
  return true;
}

/// How many pieces of the curves show themselves in a rectangle of the output, in whichever frame: with their
/// width, or the present's disc.
std::size_t PlotPainter::pointsIn(const Vec2& low, const Vec2& high) const {
  const double reach = (plot_.cursor ? kDisc : 0.5) * plot_.width * viewport_.scale;
  const Vec2 from = low - Vec2::Constant(reach);
  const Vec2 to = high + Vec2::Constant(reach);
  std::size_t count = 0;
  for (const PlotData::Points* points : curves_) {
    std::optional<Vec2> before;
    for (const PlotData::Point& point : *points) {
      const std::optional<Vec2> at = reached(place(point));
      if (at && crosses(before.value_or(*at), *at, from, to)) ++count;
      before = at;
    }
  }
  return count;
}

/// Leaves room for what stands around the axes. Of numbers that would run into each other there are fewer.
void PlotPainter::layOut() {
  placeAxes();
  while (columns_ > kLeastTicks && numbersTouch()) {
    xTicks_ = x_.ticks(--columns_);
    placeAxes();
  }
  if (xTicks_.size() > 2 && numbersTouch()) {
    xTicks_.erase(xTicks_.begin() + 1, xTicks_.end() - 1);
    placeAxes();
  }
}

/// Whether two numbers of the horizontal axis are too near to be told apart.
bool PlotPainter::numbersTouch() const {
  const double width = (inner_.high.x() - inner_.low.x()) / viewport_.scale;
  double end = -std::numeric_limits<double>::infinity();
  for (const Axis::Tick& tick : xTicks_) {
    const double half = 0.5 * texts_.measure(tick.label, textLook(NinePosition::Top, plot_.textSize)).x();
    const double at = x_.place(tick.value) * width;
    if (at - half < end + kBetween * plot_.textSize) return true;
    end = at + half;
  }
  return false;
}

void PlotPainter::placeAxes() {
  const double em = plot_.textSize;
  double widest = 0.0;
  for (const Axis::Tick& tick : yTicks_)
    widest = std::max(widest, texts_.measure(tick.label, textLook(NinePosition::Right, em)).x());
  double lastHalf = 0.0;
  if (!xTicks_.empty())
    lastHalf = 0.5 * texts_.measure(xTicks_.back().label, textLook(NinePosition::Top, em)).x();
  const double left = 0.6 * em + widest + 0.5 * em + (plot_.y.label.empty() ? 0.0 : 1.5 * em);
  const double right = std::max(0.9 * em, lastHalf + 0.3 * em);
  const double top = (plot_.title.empty() ? 0.9 * em : 2.4 * em) + legendHeight_;
  const double bottom = 2.1 * em + (plot_.x.label.empty() ? 0.0 : 1.4 * em);
  const Vec2 low(plot_.area[0] + left, plot_.area[1] + top);
  const Vec2 high(plot_.area[0] + plot_.area[2] - right, plot_.area[1] + plot_.area[3] - bottom);
  const auto output = [&](const Vec2& p) {
    const Vec2 at = p * viewport_.scale + viewport_.offset;
    return Vec2(std::round(at.x()), std::round(at.y()));
  };
  inner_ = {output(low), output(high.cwiseMax(low + Vec2(1.0, 1.0)))};
}

Vec2 PlotPainter::place(const PlotData::Point& point) const {
  return {inner_.low.x() + x_.place(point.x) * (inner_.high.x() - inner_.low.x()),
          inner_.high.y() - y_.place(point.y) * (inner_.high.y() - inner_.low.y())};
}

/// Where a curve is between a frame and the next: on the straight line that it takes from point to point. A
/// coordinate that the next frame does not have stays where it is.
Vec2 PlotPainter::between(std::size_t curve, std::size_t frame, double fraction) const {
  const PlotData::Points& points = *curves_[curve];
  if (frame >= points.size()) return Vec2::Constant(std::nan(""));
  Vec2 at = place(points[frame]);
  if (!(fraction > 0.0) || frame + 1 >= points.size()) return at;
  const Vec2 next = place(points[frame + 1]);
  for (int axis = 0; axis < 2; ++axis)
    if (std::isfinite(next[axis])) at[axis] += (next[axis] - at[axis]) * fraction;
  return at;
}

/// Where a curve goes for a point at this place: there, or towards it far enough to be clipped. Nothing at a
/// gap.
std::optional<Vec2> PlotPainter::reached(const Vec2& at) const {
  if (!std::isfinite(at.x()) || !std::isfinite(at.y())) return std::nullopt;
  const Vec2 reach = Vec2::Constant(4.0 * length(inner_.high - inner_.low));
  return Vec2(at.cwiseMax(inner_.low - reach).cwiseMin(inner_.high + reach));
}

void PlotPainter::drawFrame(Picture& picture) const {
  const double scale = viewport_.scale;
  const double em = plot_.textSize;
  const double line = std::max(std::round(0.07 * em * scale), 1.0);
  const Vec2 corner = Vec2(plot_.area[0], plot_.area[1]) * scale + viewport_.offset;
  const Vec2 size = Vec2(plot_.area[2], plot_.area[3]) * scale;
  Pen(picture, line, bytes(plot_.background)).rectangle(corner, corner + size);

  Pen gridPen(picture, line, bytes(plot_.gridColor));
  Pen pen(picture, line, bytes(plot_.ink));
  const double tick = 0.3 * em * scale;
  for (const Axis::Tick& mark : xTicks_) {
    const double at = sharp(inner_.low.x() + x_.place(mark.value) * (inner_.high.x() - inner_.low.x()), line);
    if (plot_.grid) gridPen.line({at, inner_.low.y()}, {at, inner_.high.y()});
    pen.line({at, inner_.high.y()}, {at, inner_.high.y() + tick});
    text(picture, mark.label, {at, inner_.high.y() + 0.45 * em * scale}, NinePosition::Top, em);
  }
  for (const Axis::Tick& mark : yTicks_) {
    const double at =
        sharp(inner_.high.y() - y_.place(mark.value) * (inner_.high.y() - inner_.low.y()), line);
    if (plot_.grid) gridPen.line({inner_.low.x(), at}, {inner_.high.x(), at});
    pen.line({inner_.low.x() - tick, at}, {inner_.low.x(), at});
    text(picture, mark.label, {inner_.low.x() - 0.5 * em * scale, at}, NinePosition::Right, em);
  }
  pen.line({inner_.low.x(), sharp(inner_.high.y(), line)}, {inner_.high.x(), sharp(inner_.high.y(), line)});
  pen.line({sharp(inner_.low.x(), line), inner_.low.y()}, {sharp(inner_.low.x(), line), inner_.high.y()});
  const Vec2 middle = 0.5 * (inner_.low + inner_.high);
  label(picture, plot_.x.label, {middle.x(), corner.y() + size.y() - 0.35 * em * scale},
        textLook(NinePosition::Bottom, em));
  label(picture, plot_.title, {middle.x(), corner.y() + 0.5 * em * scale},
        textLook(NinePosition::Top, 1.15 * em));
  TextLook upwards = textLook(NinePosition::Left, em);
  upwards.upwards = true;
  label(picture, plot_.y.label, {corner.x() + 0.35 * em * scale, middle.y()}, upwards);
}

/// A text in the middle of the axes. One that would leave the area so is moved along, and set smaller or cut
/// where that is not enough; then it also keeps clear of what stands around the corner.
void PlotPainter::label(Picture& picture, const std::string& text, Vec2 at, const TextLook& look) const {
  if (text.empty()) return;
  const int axis = look.upwards ? 1 : 0;
  const double scale = viewport_.scale;
  double low = plot_.area[static_cast<std::size_t>(axis)] * scale + viewport_.offset[axis];
  const double high = low + plot_.area[static_cast<std::size_t>(axis) + 2] * scale;
  if (look.upwards) low += legendHeight_ * scale;
  FittedText fitted{text, look};
  double half = 0.5 * texts_.measure(text, look)[axis] * scale;
  if (at[axis] - half < low || at[axis] + half > high) {
    const double em = plot_.textSize * scale;
    const double margin = 0.35 * em;
    const double row = 1.75 * em; // what a label takes up
    const bool yLabel = !plot_.y.label.empty();
    double from = low + (!look.upwards && yLabel ? row : margin);
    double to = high - (look.upwards && !plot_.x.label.empty() ? row : margin);
    if (look.upwards && !plot_.title.empty()) from += row;
    to = std::max(to, from);
    fitted = fitText(texts_, text, look, (to - from) / scale, kLeastShare * look.size);
    half = 0.5 * texts_.measure(fitted.text, fitted.look)[axis] * scale;
    at[axis] = std::clamp(at[axis], from + half, std::max(to - half, from + half));
  }
  if (!fitted.text.empty()) texts_.draw(picture, fitted.text, fitted.look, (at - viewport_.offset) / scale);
}

void PlotPainter::grow(Grown& grown, std::size_t curve, std::size_t frames) const {
  const PlotData::Points& points = *curves_[curve];
  const std::size_t end = std::min(frames, points.size());
  if (end < grown.frames) grown = Grown{.open = PathSimplifier(kTolerance)};
  for (; grown.frames < end; ++grown.frames) {
    if (const std::optional<Vec2> at = reached(place(points[grown.frames]))) {
      grown.open.add(*at);
      continue;
    }
    // There is a gap.
    if (std::vector<Vec2> run = grown.open.path(); !run.empty()) grown.runs.push_back(std::move(run));
    grown.open.clear();
  }
}

void PlotPainter::drawCurve(Picture& picture, std::size_t curve, std::size_t frames, double fraction,
                            std::int32_t clip) const {
  Grown& grown = grown_[curve];
  grow(grown, curve, frames);
  Pen pen(picture, plot_.width * viewport_.scale, bytes(plot_.curves[curve].color), clip);
  for (const std::vector<Vec2>& run : grown.runs) pen.path(run);
  if (fraction > 0.0 && frames > 0) {
    if (const std::optional<Vec2> end = reached(between(curve, frames - 1, fraction))) {
      PathSimplifier open = grown.open; // without the end, which is another one in the next picture
      open.add(*end);
      return pen.path(open.path());
    }
  }
  pen.path(grown.open.path());
}

void PlotPainter::draw(Picture& picture, std::span<const std::int64_t> frames, double fraction) const {
  append(picture, still_);
  const auto clip = static_cast<std::int32_t>(picture.clips.size());
  // A line on an axis is seen in its full width.
  const int edge = static_cast<int>(std::ceil(plot_.width * viewport_.scale));
  picture.clips.push_back({static_cast<int>(inner_.low.x()) - edge, static_cast<int>(inner_.low.y()) - edge,
                           static_cast<int>(inner_.high.x()) + edge,
                           static_cast<int>(inner_.high.y()) + edge});
  for (std::size_t curve = 0; curve < curves_.size(); ++curve)
    drawCurve(picture, curve,
              plot_.whole ? curves_[curve]->size() : static_cast<std::size_t>(frames[curve]) + 1,
              plot_.whole ? 0.0 : fraction, clip);
  if (plot_.cursor) drawPresent(picture, frames, fraction, clip);
  if (plot_.legend) legend_.draw(picture);
}

/// A disc at each curve's present, over a line at the latest of them where they are over time. A disc whose
/// middle is within the axes is whole, also at their edge; the plot's area alone cuts one that is very large.
void PlotPainter::drawPresent(Picture& picture, std::span<const std::int64_t> frames, double fraction,
                              std::int32_t clip) const {
  const double line = std::max(std::round(0.08 * plot_.textSize * viewport_.scale), 1.0);
  std::vector<Vec2> discs;
  Extent x;
  for (std::size_t curve = 0; curve < curves_.size(); ++curve) {
    discs.push_back(between(curve, static_cast<std::size_t>(frames[curve]), fraction));
    x.add(discs.back().x(), false);
  }
  if (plot_.overTime && std::isfinite(x.greatest)) {
    const double at = sharp(x.greatest, line);
    Pen(picture, line, faded(bytes(plot_.ink), 0.5), clip).line({at, inner_.low.y()}, {at, inner_.high.y()});
  }
  const auto area = static_cast<std::int32_t>(picture.clips.size());
  const Vec2 corner = Vec2(plot_.area[0], plot_.area[1]) * viewport_.scale + viewport_.offset;
  const Vec2 end = corner + Vec2(plot_.area[2], plot_.area[3]) * viewport_.scale;
  const PixelRect& pane = viewport_.clip;
  picture.clips.push_back({std::max(pane.left, static_cast<int>(std::floor(corner.x()))),
                           std::max(pane.top, static_cast<int>(std::floor(corner.y()))),
                           std::min(pane.right, static_cast<int>(std::ceil(end.x()))),
                           std::min(pane.bottom, static_cast<int>(std::ceil(end.y())))});
  for (std::size_t curve = 0; curve < curves_.size(); ++curve) {
    if (isWithin(discs[curve], inner_.low, inner_.high))
      Pen(picture, line, bytes(plot_.curves[curve].color), area)
          .disc(discs[curve], kDisc * plot_.width * viewport_.scale);
  }
}

} // namespace offstage
