#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace offstage {

/// How far a render is.
struct ProgressState {
  std::int64_t done = 0;     ///< frames
  std::int64_t frames = 0;   ///< of the whole
  double fps = 0.0;          ///< frames made a second
  double speed = 0.0;        ///< seconds of video made a second
  double elapsed = 0.0;      ///< s
  std::optional<double> eta; ///< s; nothing while no frame is made
  std::int64_t bytes = 0;    ///< so far
  bool last = false;         ///< it has ended
};

/// One line for a terminal of so many columns, without its end: the numbers, and a bar where they leave room
/// for one. It never fills the last column, where some terminals begin another line.
std::string progressLine(const ProgressState& state, int columns);

/// The same as a JSON object; `eta` is null while it is not known.
std::string progressJson(const ProgressState& state);

} // namespace offstage
