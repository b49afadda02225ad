#include "src/sim/clock.h"

#include "src/sim/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace offstage {
namespace {

constexpr double kNanosecondsPerSecond = 1e9;

} // namespace

Clock Clock::fixed(double fps, std::int64_t steps) {
  if (!std::isfinite(fps) || fps <= 0.0) {
    throw Error(ExitCode::BadInput,
                "a clock's fps must be a finite number above 0, but it is " + std::to_string(fps));
  }
  if (steps < 0) {
    throw Error(ExitCode::BadInput,
                "a clock's number of steps must not be negative, but it is " + std::to_string(steps));
  }
  Clock clock;
  clock.fps_ = fps;
  clock.steps_ = steps;
  return clock;
}

Clock Clock::recorded(const std::vector<std::int64_t>& durations) {
  Clock clock;
  clock.elapsed_.reserve(durations.size() + 1);
  std::int64_t sum = 0;
  clock.elapsed_.push_back(sum);
  for (std::size_t i = 0; i < durations.size(); ++i) {
    const std::int64_t duration = durations[i];
    if (duration < 0) {
      throw Error(ExitCode::BadInput, "frame " + std::to_string(i + 1) + " lasts " +
                                          std::to_string(duration) + " ns; a duration must not be negative");
    }
    if (duration > std::numeric_limits<std::int64_t>::max() - sum) {
      throw Error(ExitCode::BadInput, "the durations up to frame " + std::to_string(i + 1) +
                                          " are longer than 64-bit nanoseconds can count (292 years)");
    }
    sum += duration;
    clock.elapsed_.push_back(sum);
  }
  clock.steps_ = static_cast<std::int64_t>(durations.size());
  return clock;
}

double Clock::time(std::int64_t frame) const {
  if (frame < 0 || frame > steps_) {
    throw std::out_of_range("Clock::time: there is no frame " + std::to_string(frame) + " among 0 … " +
                            std::to_string(steps_));
  }
  if (isFixed()) return static_cast<double>(frame) / fps_;
  return static_cast<double>(elapsed_[static_cast<std::size_t>(frame)]) / kNanosecondsPerSecond;
}

Tick Clock::tick(std::int64_t frame) const {
  if (frame < 1) throw std::out_of_range("Clock::tick: the first step leads to frame 1");
  const double now = time(frame);
  return {frame, now, isFixed() ? 1.0 / fps_ : now - time(frame - 1)};
}

std::int64_t Clock::nanoseconds(std::int64_t frame) const {
  if (!isFixed()) return elapsed_.at(static_cast<std::size_t>(frame));
  const double exact = std::round(static_cast<double>(frame) * kNanosecondsPerSecond / fps_);
  // 2^63 as a double: from here on the count does not fit.
  return exact < 0x1.0p63 ? static_cast<std::int64_t>(exact) : std::numeric_limits<std::int64_t>::max();
}

Clock Clock::truncated(std::int64_t steps) const {
  Clock clock = *this;
  clock.steps_ = std::clamp<std::int64_t>(steps, 0, steps_);
  if (!isFixed()) clock.elapsed_.resize(static_cast<std::size_t>(clock.steps_) + 1);
  return clock;
}

std::int64_t Clock::frameAt(double seconds) const {
  if (!(seconds > 0.0)) return 0; // also when it is NaN
  // Times never decrease from frame to frame, so the last one that is not after `seconds` is found by
  // bisection.
  std::int64_t notAfter = 0;
  std::int64_t after = steps_;
  if (time(after) <= seconds) return after;
  while (after - notAfter > 1) {
    const std::int64_t middle = notAfter + (after - notAfter) / 2;
    (time(middle) <= seconds ? notAfter : after) = middle;
  }
  return notAfter;
}

} // namespace offstage
