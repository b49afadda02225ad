#include "render/job/schedule.h"

#include "src/sim/error.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace offstage {
namespace {

// duration*fps is seldom whole in doubles (1.6666666666666667*60 = 100.00000000000001); a millionth of a
// frame is no frame.
std::int64_t framesIn(double seconds, double fps) {
  return static_cast<std::int64_t>(std::ceil(seconds * fps - 1e-6));
}

std::int64_t nanosecondsOf(double seconds) {
  return std::llround(seconds * 1e9);
}

} // namespace

Schedule::Schedule(const Clock& clock, std::optional<double> from, std::optional<double> to,
                   std::optional<double> fps, const Film* film)
    : clock_(clock), film_(film != nullptr && film->map ? film : nullptr) {
  const double duration = film_ != nullptr ? film_->seconds : clock.duration();
  const double begin = from.value_or(0.0);
  const double end = to.value_or(duration);
  if (!(begin >= 0.0) || !std::isfinite(begin))
    throw Error(ExitCode::BadInput, fmt::format("--from {} is not a time from 0 on", begin));
  if (!(end <= duration + 1e-9))
    throw Error(ExitCode::BadInput, fmt::format("--to {} lies after the end at {} s", end, duration));
  if (clock.steps() == 0) throw Error(ExitCode::BadInput, "nothing to render: the duration holds no frame");
  if (!(begin < end))
    throw Error(ExitCode::BadInput, fmt::format("nothing to render between {} s and {} s", begin, end));
  if (fps && !(std::isfinite(*fps) && *fps > 0.0))
    throw Error(ExitCode::BadInput, fmt::format("--fps {} is not a number above 0", *fps));

  if (film_ != nullptr) {
    fps_ = film_->fps;
    first_ = std::max<std::int64_t>(framesIn(begin, fps_), 0);
    frames_ = std::min(framesIn(end, fps_), film_->map->frames()) - first_;
  } else if (clock.isFixed()) {
    fps_ = clock.fps();
    first_ = std::max<std::int64_t>(framesIn(begin, fps_), 0);
    frames_ = std::min(framesIn(end, fps_), clock.steps()) - first_;
    originNs_ = clock.nanoseconds(first_);
  } else if (fps) {
    fps_ = *fps;
    origin_ = begin;
    frames_ = framesIn(end - begin, fps_);
    originNs_ = nanosecondsOf(begin);
  } else {
    first_ = clock.frameAt(begin);
    // The frame at `end` itself is the next one's; a frame of length 0 just before it is never seen.
    std::int64_t last = clock.frameAt(end);
    while (last > first_ && clock.time(last) >= end) --last;
    frames_ = std::min(last + 1, clock.steps()) - first_;
    originNs_ = nanosecondsOf(begin);
    if (!from) originNs_ = 0;
  }
  if (frames_ <= 0)
    throw Error(ExitCode::BadInput, fmt::format("no frame lies between {} s and {} s", begin, end));
  endNs_ = to || film_ != nullptr ? nanosecondsOf(end) : clock.nanoseconds(clock.steps());
}

double Schedule::origin() const {
  if (film_ != nullptr || clock_.isFixed()) return static_cast<double>(first_) / fps_;
  return static_cast<double>(originNs_) / 1e9;
}

Shot Schedule::shot(std::int64_t index) const {
  if (film_ != nullptr) return {film_->moment(first_ + index), static_cast<double>(first_ + index) / fps_};
  if (clock_.isFixed()) return {{first_ + index, 0.0}, clock_.time(first_ + index)};
  if (fps_ == 0.0) return {{first_ + index, 0.0}, std::max(clock_.time(first_ + index), origin())};
  const double time = origin_ + static_cast<double>(index) / fps_;
  // A frame that is due within the rounding of its own time counts as due.
  return {{std::min(clock_.frameAt(time + 1e-9), clock_.steps()), 0.0}, time};
}

std::int64_t Schedule::simulated(std::int64_t index) const {
  return shot(index).moment.frame;
}

std::int64_t Schedule::startOf(std::int64_t index) const {
  if (fps_ > 0.0) return nanosecondsOf(static_cast<double>(index) / fps_);
  if (index == 0) return 0;
  if (index == frames_) return endNs_ - originNs_;
  return clock_.nanoseconds(first_ + index) - originNs_;
}

FrameTiming Schedule::timing(std::int64_t index) const {
  return {index, startOf(index), startOf(index + 1)};
}

double Schedule::seconds() const {
  return static_cast<double>(startOf(frames_)) / 1e9;
}

Schedule scheduleOf(const Source& source, const RenderOptions& options) {
  return {source.clock(), options.from, options.to, source.clock().isFixed() ? std::nullopt : options.fps,
          source.film()};
}

} // namespace offstage
