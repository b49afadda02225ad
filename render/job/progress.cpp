#include "render/job/progress.h"

#include "render/job/console.h"
#include "render/job/progress_line.h"

#include <string>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr auto kInterval = std::chrono::milliseconds(100);

} // namespace

Progress::Progress(ProgressMode mode, std::int64_t frames, double seconds, std::int64_t before,
                   std::FILE* stream)
    : mode_(mode), frames_(frames), seconds_(seconds), before_(before), stream_(stream) {
  if (mode_ == ProgressMode::Auto && terminalColumns(stream) == 0) mode_ = ProgressMode::None;
}

Progress::~Progress() {
  if (shownColumns_ > 0) say(stream_, "\n");
}

void Progress::update(std::int64_t framesDone, std::int64_t bytes) {
  if (mode_ == ProgressMode::None) return;
  const auto now = SteadyClock::now();
  if (now - shown_ < kInterval) return;
  shown_ = now;
  show(framesDone, bytes, false);
}

void Progress::finish(std::int64_t bytes) {
  if (mode_ != ProgressMode::None) show(frames_, bytes, true);
}

void Progress::show(std::int64_t framesDone, std::int64_t bytes, bool last) {
  ProgressState state;
  state.done = framesDone;
  state.frames = frames_;
  state.elapsed = std::chrono::duration<double>(SteadyClock::now() - start_).count();
  state.fps = state.elapsed > 0.0 ? static_cast<double>(framesDone - before_) / state.elapsed : 0.0;
  state.speed = frames_ > 0 ? state.fps * seconds_ / static_cast<double>(frames_) : 0.0;
  if (framesDone >= frames_)
    state.eta = 0.0;
  else if (state.fps > 0.0)
    state.eta = static_cast<double>(frames_ - framesDone) / state.fps;
  state.bytes = bytes;
  state.last = last;
  if (mode_ == ProgressMode::Json) {
    say(stream_, progressJson(state) + "\n");
    return;
  }
  // Spaces cover what a longer line before has left: unlike an escape sequence they do so on any terminal.
  const std::string line = progressLine(state, terminalColumns(stream_));
  say(stream_, fmt::format("\r{:<{}}{}", line, shownColumns_, last ? "\n" : ""));
  shownColumns_ = last ? 0 : line.size();
}

} // namespace offstage
