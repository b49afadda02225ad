#pragma once

#include "src/scene/warning_text.h"
#include "src/sim/warning.h"
#include "src/sim/watch.h"
#include "src/sim/world.h"

#include <atomic>
#include <cstddef>
#include <string>

namespace offstage {

/// Tells the warnings of one run on stderr, each kind once, whichever process sees it first: a run is often
/// simulated more than once, by the process that forks workers, by the workers, for a poster.
class WarningLog {
public:
  /// Strict: a warning is an error, and report() throws it.
  enum class Mode : bool { Tell, Strict };

  explicit WarningLog(Mode mode = Mode::Tell);
  ~WarningLog();
  WarningLog(const WarningLog&) = delete;
  WarningLog& operator=(const WarningLog&) = delete;

  /// Prints "FILE: warning: …" when nothing of this kind has been told. Throws Error(BadInput) when strict.
  void report(const Warning& warning, const WarningText& text);

private:
  static_assert(std::atomic<bool>::is_always_lock_free, "processes cannot share a lock");

  Mode mode_;
  std::atomic<bool>* told_; ///< by kind; shared with the processes that are forked from this one
};

/// A world's watch, whose warnings go to a log.
class WatchedRun {
public:
  /// `world` is at frame 0. The log has to outlive this.
  WatchedRun(const World& world, WarningText text, WarningLog& log);

  /// world.step(tick), watched. What the scene is meant to show is not reported.
  void step(World& world, const Tick& tick);

private:
  Watch watch_;
  WarningText text_;
  WarningLog* log_;
};

} // namespace offstage
