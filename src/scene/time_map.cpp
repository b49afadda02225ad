#include "src/scene/time_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace offstage {

TimeMap::TimeMap(std::int64_t frames, const std::vector<Run>& runs) : end_(static_cast<double>(frames)) {
  std::int64_t done = 0;
  for (const Run& run : runs) {
    append(run.first - done, static_cast<double>(done), 1, 1);
    append(run.frames, static_cast<double>(run.first), run.end - run.first, run.frames);
    done = run.end;
    if (run.frames != run.end - run.first) identity_ = false;
  }
  append(frames - done, static_cast<double>(done), 1, 1);
}

void TimeMap::append(std::int64_t count, double origin, std::int64_t numerator, std::int64_t denominator) {
  if (count <= 0) return;
  const std::int64_t common = std::gcd(numerator, denominator);
  numerator /= common;
  denominator /= common;
  stretches_.push_back(
      {frames_, count, 0, origin, static_cast<double>(numerator), static_cast<double>(denominator), kNoTag});
  frames_ += count;
}

const TimeMap::Stretch* TimeMap::find(std::int64_t frame) const {
  const auto after =
      std::upper_bound(stretches_.begin(), stretches_.end(), frame,
                       [](std::int64_t number, const Stretch& stretch) { return number < stretch.first; });
  if (after == stretches_.begin() || frame >= frames_) return nullptr;
  return &*std::prev(after);
}

void TimeMap::stand(std::int64_t at, std::int64_t count, std::optional<double> position, int tag) {
  if (count <= 0) return;
  identity_ = false;
  const Stretch standing{at, count, 0, position.value_or(this->position(at)), 0.0, 1.0, tag};
  auto place = stretches_.begin();
  while (place != stretches_.end() && place->first + place->count <= at) ++place;
  if (place != stretches_.end() && place->first < at) {
    Stretch rest = *place;
    rest.skip += at - place->first;
    rest.count -= at - place->first;
    rest.first = at;
    place->count = at - place->first;
    place = stretches_.insert(std::next(place), rest);
  }
  place = stretches_.insert(place, standing);
  for (++place; place != stretches_.end(); ++place) place->first += count;
  frames_ += count;
}

double TimeMap::position(std::int64_t frame) const {
  const Stretch* stretch = find(frame);
  return stretch == nullptr ? end_ : stretch->at(frame);
}

bool TimeMap::isSlow(std::int64_t frame) const {
  const Stretch* stretch = find(frame);
  return stretch != nullptr && stretch->numerator < stretch->denominator;
}

std::int64_t TimeMap::firstAt(double position) const {
  std::int64_t low = 0;
  std::int64_t high = frames_;
  while (low < high) {
    const std::int64_t middle = low + (high - low) / 2;
    if (this->position(middle) < position)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

double TimeMap::inverse(double position) const {
  for (const Stretch& stretch : stretches_) {
    if (stretch.numerator == 0.0) continue;
    const double end = stretch.at(stretch.first + stretch.count);
    if (position > end) continue;
    const double along = (position - stretch.origin) * stretch.denominator / stretch.numerator;
    return static_cast<double>(stretch.first) + std::max(along - static_cast<double>(stretch.skip), 0.0);
  }
  return static_cast<double>(frames_);
}

std::pair<std::int64_t, std::int64_t> TimeMap::range(int tag) const {
  std::pair<std::int64_t, std::int64_t> range{0, 0};
  bool found = false;
  for (const Stretch& stretch : stretches_) {
    if (stretch.tag != tag) continue;
    if (!found) range.first = stretch.first;
    range.second = stretch.first + stretch.count;
    found = true;
  }
  return range;
}

} // namespace offstage
