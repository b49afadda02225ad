#pragma once

#include "src/scene/trace_reader.h"
#include "src/sim/body.h"
#include "src/sim/clock.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace offstage {

/// `[replay]`: a motion that is drawn as a trace has it; nothing is simulated.
struct Replay {
  /// What is on show from a moment on: `rows[first]` up to `rows[first + count − 1]`.
  struct Frame {
    double time = 0.0; ///< s since the replay's start
    std::size_t first = 0;
    std::size_t count = 0; ///< 0: nothing
  };
  Trace trace;
  std::vector<Frame> frames;        ///< by time; the first at 0
  std::vector<std::uint32_t> looks; ///< by row of the trace: index into Scene::looks
};

/// When a trace's frames are on show, from `start` on (s of the trace; without it, from the first row). Where
/// frames are missing between two of the trace, no body was alive, and nothing is on show from the frame
/// after the one before the gap; a trace that tells of every tenth frame only has no gaps. `trace` must have
/// rows and `start` not lie after the last of them.
std::vector<Replay::Frame> replayFrames(const Trace& trace, std::optional<double> start);

/// The clock of such frames: fixed when they are evenly spaced (a whole number a second, to the microsecond)
/// and `mayBeFixed`, else recorded.
Clock replayClock(const std::vector<Replay::Frame>& frames, bool mayBeFixed);

/// A replay at one of its frames; steps as a World does.
class ReplayMotion {
public:
  explicit ReplayMotion(std::shared_ptr<const Replay> replay);

  void step(const Tick& tick); ///< tick.frame must be frame() + 1 (std::invalid_argument otherwise)

  [[nodiscard]] std::int64_t frame() const { return frame_; }
  [[nodiscard]] double time() const { return time_; } ///< s
  /// Circles in the order of their ids; velocities are 0 where the trace has none. Valid until the next step.
  [[nodiscard]] std::span<const Body> bodies() const { return bodies_; }
  [[nodiscard]] std::uint64_t stateHash() const;

private:
  void takeBodies();

  std::shared_ptr<const Replay> replay_;
  std::vector<Body> bodies_;
  std::int64_t frame_ = 0;
  double time_ = 0.0;
};

} // namespace offstage
