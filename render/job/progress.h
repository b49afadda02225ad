#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>

namespace offstage {

enum class ProgressMode : std::uint8_t {
  Auto, ///< a bar when the stream is a terminal, nothing otherwise
  Json, ///< a JSON object a line
  None,
};

/// Tells on stderr how far a render is: at most ten times a second, and once at the end.
class Progress {
public:
  /// `seconds` = length of the whole video in s; `before` = frames that an earlier run has made, which count
  /// for how far it is but not for how fast; `stream` is stderr but in tests.
  Progress(ProgressMode mode, std::int64_t frames, double seconds, std::int64_t before = 0,
           std::FILE* stream = stderr);
  ~Progress(); ///< ends the bar's line, so that an error message does not run into it
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(std::int64_t framesDone, std::int64_t bytes);
  void finish(std::int64_t bytes);

private:
  using SteadyClock = std::chrono::steady_clock;
  void show(std::int64_t framesDone, std::int64_t bytes, bool last);

  ProgressMode mode_;
  std::int64_t frames_;
  double seconds_;
  std::int64_t before_;
  std::FILE* stream_;
  SteadyClock::time_point start_ = SteadyClock::now();
  SteadyClock::time_point shown_{};
  std::size_t shownColumns_ = 0; ///< of the bar on show; 0: none
};

} // namespace offstage
