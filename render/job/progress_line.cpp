#include "render/job/progress_line.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr int kMostBar = 28; ///< columns
constexpr int kLeastBar = 5; ///< columns; a shorter one says less than the numbers
constexpr int kBarFrame = 3; ///< columns of its brackets and the space behind it

std::string clockText(double seconds) {
  const std::int64_t whole = std::llround(seconds);
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string timeText(const ProgressState& state) {
  if (state.last) return "took " + clockText(state.elapsed);
  return "ETA " + (state.eta ? clockText(*state.eta) : "-:--");
}

} // namespace

std::string progressLine(const ProgressState& state, int columns) {
  std::string numbers = fmt::format("{}/{} frames  {:.0f} fps  {:.1f}x  {}  {} KiB", state.done, state.frames,
                                    state.fps, state.speed, timeText(state), state.bytes / 1024);
  const int room = std::max(columns - 1, 0);
  const int bar = std::min(room - kBarFrame - static_cast<int>(numbers.size()), kMostBar);
  if (bar < kLeastBar) {
    numbers.resize(std::min(numbers.size(), static_cast<std::size_t>(room)));
    return numbers;
  }
  const double share =
      state.frames > 0 ? static_cast<double>(state.done) / static_cast<double>(state.frames) : 1.0;
  const int filled = std::clamp(static_cast<int>(share * bar), 0, bar);
  return fmt::format("[{:#<{}}{:.<{}}] {}", "", filled, "", bar - filled, numbers);
}

std::string progressJson(const ProgressState& state) {
  return fmt::format(
      "{{\"event\":\"{}\",\"frame\":{},\"frames\":{},\"fps\":{:.1f},\"speed\":{:.2f},\"elapsed\":{:.2f},"
      "\"eta\":{},\"bytes\":{}}}",
      state.last ? "done" : "progress", state.done, state.frames, state.fps, state.speed, state.elapsed,
      state.eta ? fmt::format("{:.1f}", *state.eta) : "null", state.bytes);
}

} // namespace offstage
