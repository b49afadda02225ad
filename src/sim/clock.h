#pragma once

#include <cstdint>
#include <vector>

namespace offstage {

/// One step of the main loop: from frame − 1 to frame.
struct Tick {
  std::int64_t frame = 0; ///< number of the frame that the step leads to, from 1
  double time = 0.0;      ///< s: the time of that frame
  double dt = 0.0;        ///< s: the step's length (of the whole frame; substeps divide it)
};

/// When frames happen. Frame 0 is at time 0; frame k is the state after k steps. A clock holds no position in
/// time, so any frame's tick can be asked for in any order and copies are cheap enough for forked workers.
class Clock {
public:
  /// Equal steps: frame k is at k/fps (one division) and every dt is 1/fps.
  /// `steps` = number of steps, ≥ 0. Throws Error(BadInput) unless fps is finite and > 0.
  static Clock fixed(double fps, std::int64_t steps);

  /// Steps recorded by a real main loop: `durations` in ns, each ≥ 0 (0: two frames at the same time).
  /// time(k) = (sum of the first k durations)/1e9 in one division; dt = time(k) − time(k−1), which is not
  /// duration/1e9 in the last bits but is what the lecture's handle(now) computes. Throws Error(BadInput) on
  /// a negative duration or a sum that overflows.
  static Clock recorded(const std::vector<std::int64_t>& durations);

  [[nodiscard]] std::int64_t steps() const { return steps_; }
  [[nodiscard]] bool isFixed() const { return elapsed_.empty(); }
  [[nodiscard]] double fps() const { return fps_; }    ///< 1/s; of a fixed clock, 0 of a recorded one
  [[nodiscard]] double time(std::int64_t frame) const; ///< s; 0 ≤ frame ≤ steps()
  [[nodiscard]] Tick tick(std::int64_t frame) const;   ///< 1 ≤ frame ≤ steps()
  [[nodiscard]] std::int64_t
  nanoseconds(std::int64_t frame) const;                         ///< recorded: the exact sum; fixed: rounded
  [[nodiscard]] double duration() const { return time(steps_); } ///< s: time of the last frame

  /// The first `steps` steps of this clock (all of them when there are fewer).
  [[nodiscard]] Clock truncated(std::int64_t steps) const;

  /// Number of the last frame whose time is ≤ `seconds` (0 when seconds ≤ 0).
  [[nodiscard]] std::int64_t frameAt(double seconds) const;

private:
  double fps_ = 0.0;
  std::int64_t steps_ = 0;
  std::vector<std::int64_t> elapsed_; ///< ns at frame k, elapsed_[0] = 0; empty for a fixed clock
};

} // namespace offstage
