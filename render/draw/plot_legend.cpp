#include "render/draw/plot_legend.h"

#include "render/draw/fit_text.h"
#include "render/draw/pen.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace offstage {
namespace {

// In em of the plot's texts.
constexpr double kLine = 1.7;          ///< how long a line is
constexpr double kName = 2.2;          ///< from its left end to the name
constexpr double kRow = 1.35;          ///< from name to name, downwards
constexpr double kApart = 1.2;         ///< between two entries of a row
constexpr double kAway = 0.4;          ///< of the box from the axes
constexpr double kBefore = 0.5;        ///< in the box, left of the entries
constexpr double kBeside = 0.9;        ///< the same on both sides together
constexpr double kAboveOrBelow = 0.25; ///< in the box
constexpr std::uint8_t kGround = 215;  ///< the box's alpha

} // namespace

PlotLegend::PlotLegend(const Plot& plot, const Viewport& viewport, const TextPainter& texts)
    : viewport_(viewport),
      texts_(texts),
      curves_(plot.curves),
      textSize_(plot.textSize),
      width_(plot.width),
      ground_{plot.background.red, plot.background.green, plot.background.blue,
              std::min(plot.background.alphaByte(), kGround)} {
  look_.color = plot.ink;
  look_.anchor = NinePosition::Left;
  setSize(plot.textSize);
}

void PlotLegend::setSize(double size) {
  look_.size = size;
  em_ = size * viewport_.scale;
  line_ = std::max(width_, 0.15 * size) * viewport_.scale;
}

/// All of one size: that of the name which needs the smallest.
void PlotLegend::setNames(double room) {
  const double nameRoom = std::max(room - kName * em_, 0.0) / viewport_.scale;
  const double least = kLeastShare * textSize_; // also of a legend that is smaller
  TextLook look = look_;
  for (const PlotCurve& curve : curves_)
    look.size = std::min(look.size, fitText(texts_, curve.name, look_, nameRoom, least).look.size);
  entries_.clear();
  for (const PlotCurve& curve : curves_) {
    FittedText name{curve.name, look};
    if (look.size <= least) name = fitText(texts_, curve.name, look, nameRoom, least);
    const double width = texts_.measure(name.text, name.look).x() * viewport_.scale;
    entries_.push_back({std::move(name.text), name.look, width + kName * em_, curve.color});
  }
}

double PlotLegend::widest() const {
  double widest = 0.0;
  for (const Entry& entry : entries_) widest = std::max(widest, entry.width);
  return widest;
}

/// The corners by preference: 0 … 3.
PlotLegend::Box PlotLegend::boxIn(int corner, const Vec2& low, const Vec2& high) const {
  const Vec2 size(widest() + kBeside * em_,
                  (kRow * static_cast<double>(entries_.size()) + 2.0 * kAboveOrBelow) * em_);
  const Vec2 away = Vec2::Constant(kAway * em_);
  Vec2 at = low + away;
  const Vec2 far = high - size - away;
  if (corner == 0 || corner == 2) at.x() = far.x();
  if (corner >= 2) at.y() = far.y();
  return {at, at + size};
}

void PlotLegend::goTo(const Box& box) {
  box_ = box;
  Vec2 at = box.low + Vec2(kBefore, kAboveOrBelow + 0.5 * kRow) * em_;
  for (Entry& entry : entries_) {
    entry.at = at;
    at.y() += kRow * em_;
  }
}

bool PlotLegend::toFreeCorner(const Vec2& low, const Vec2& high, const Crossing& crossing) {
  setNames(std::numeric_limits<double>::infinity());
  for (int corner = 0; corner < 4; ++corner) {
    const Box box = boxIn(corner, low, high);
    if ((box.low.array() < low.array()).any() || (box.high.array() > high.array()).any()) return false;
    if (crossing(box.low, box.high) > 0) continue;
    goTo(box);
    return true;
  }
  return false;
}

void PlotLegend::leaveOut() {
  entries_.clear();
  box_.reset();
}

/// Where each of `count` columns ends, from the first one's beginning.
std::vector<double> PlotLegend::columnEnds(std::size_t count) const {
  std::vector<double> ends;
  for (std::size_t column = 0; column < count; ++column) {
    double width = 0.0;
    for (std::size_t i = column; i < entries_.size(); i += count) width = std::max(width, entries_[i].width);
    ends.push_back(width + (ends.empty() ? 0.0 : ends.back() + kApart * em_));
  }
  return ends;
}

double PlotLegend::toRows(double left, double right, double middle, double top) {
  setNames(right - left);
  box_.reset();
  std::size_t count = entries_.size();
  std::vector<double> ends = columnEnds(count);
  while (count > 1 && ends.back() > right - left) ends = columnEnds(--count);
  const double begin = std::clamp(middle - 0.5 * ends.back(), left, std::max(left, right - ends.back()));
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const std::size_t column = i % count;
    const std::size_t row = i / count;
    entries_[i].at = {begin + (column == 0 ? 0.0 : ends[column - 1] + kApart * em_),
                      top + (static_cast<double>(row) + 0.5) * kRow * em_};
  }
  const std::size_t rows = (entries_.size() + count - 1) / count;
  return static_cast<double>(rows) * kRow * em_;
}

void PlotLegend::draw(Picture& picture) const {
  if (box_) Pen(picture, 1.0, ground_).rectangle(box_->low, box_->high);
  for (const Entry& entry : entries_) {
    const Vec2 from(entry.at.x(), std::round(entry.at.y()));
    const Color& color = entry.color;
    Pen(picture, line_, {color.red, color.green, color.blue, color.alphaByte()})
        .line(from, from + Vec2(kLine * em_, 0.0));
    if (entry.name.empty()) continue;
    const Vec2 name = entry.at + Vec2(kName * em_, 0.0);
    texts_.draw(picture, entry.name, entry.look, (name - viewport_.offset) / viewport_.scale);
  }
}

} // namespace offstage
