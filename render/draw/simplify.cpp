#include "render/draw/simplify.h"

#include <cmath>

namespace offstage {
namespace {

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

} // namespace

void PathSimplifier::clear() {
  kept_.clear();
  pending_ = false;
}

/// Narrows the cone to the directions that pass the point within the tolerance.
void PathSimplifier::narrow(const Vec2& point) {
  const Vec2 along = point - kept_.back();
  const double distance = length(along);
  if (!(distance > tolerance_)) return;
  const Vec2 aside = Vec2(-along.y(), along.x()) * (tolerance_ / distance);
  const Vec2 low = along - aside;
  const Vec2 high = along + aside;
  const bool open = low_ == high_; // nothing has narrowed it yet
  if (open || cross(low_, low) > 0.0) low_ = low;
  if (open || cross(high, high_) > 0.0) high_ = high;
}

bool PathSimplifier::turns(const Vec2& step) const {
  return first_.dot(step) < leastCosine_ * length(first_) * length(step);
}

void PathSimplifier::add(const Vec2& point) {
  if (kept_.empty()) {
    kept_.push_back(point);
    low_ = high_ = Vec2::Zero();
    return;
  }
  const Vec2 along = point - kept_.back();
  // It must go on, and lie in the cone of all points before.
  const bool open = low_ == high_;
  const bool onward = !pending_ || along.dot(point - last_) >= 0.0;
  const bool inside = open || (cross(low_, along) >= 0.0 && cross(along, high_) >= 0.0);
  if (pending_ && (!onward || !inside || turns(point - last_))) {
    kept_.push_back(last_);
    low_ = high_ = Vec2::Zero();
    pending_ = false;
  }
  if (!pending_) first_ = point - kept_.back();
  last_ = point;
  pending_ = true;
  narrow(point);
}

std::vector<Vec2> PathSimplifier::path() const {
  std::vector<Vec2> path;
  appendTo(path);
  return path;
}

void PathSimplifier::appendTo(std::vector<Vec2>& path) const {
  path.insert(path.end(), kept_.begin(), kept_.end());
  if (pending_) path.push_back(last_);
}

} // namespace offstage
