#include "render/job/progress.h"

#include <string>
#include <unistd.h>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr auto kInterval = std::chrono::milliseconds(100);
constexpr int kBarWidth = 28;

std::string clockText(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds + 0.5);
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

} // namespace

Progress::Progress(ProgressMode mode, std::int64_t frames, double seconds, std::int64_t before,
                   std::FILE* stream)
    : mode_(mode), frames_(frames), seconds_(seconds), before_(before), stream_(stream) {
  if (mode_ == ProgressMode::Auto && isatty(fileno(stream)) == 0) mode_ = ProgressMode::None;
}

Progress::~Progress() {
  if (lineOpen_) std::fputc('\n', stream_);
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
  const double elapsed = std::chrono::duration<double>(SteadyClock::now() - start_).count();
  const double share = frames_ > 0 ? static_cast<double>(framesDone) / static_cast<double>(frames_) : 1.0;
  const double rate = elapsed > 0.0 ? static_cast<double>(framesDone - before_) / elapsed : 0.0;
  const double speed = frames_ > 0 ? rate * seconds_ / static_cast<double>(frames_) : 0.0;
  const double remaining = rate > 0.0 ? static_cast<double>(frames_ - framesDone) / rate : 0.0;
  if (mode_ == ProgressMode::Json) {
    fmt::print(
        stream_,
        "{{\"event\":\"{}\",\"frame\":{},\"frames\":{},\"fps\":{:.1f},\"speed\":{:.2f},\"elapsed\":{:.2f},"
        "\"eta\":{:.1f},\"bytes\":{}}}\n",
        last ? "done" : "progress", framesDone, frames_, rate, speed, elapsed, remaining, bytes);
  } else {
    const int filled = static_cast<int>(share * kBarWidth);
    fmt::print(stream_, "\r[{:#<{}}{:.<{}}] {}/{} frames  {:.0f} fps  {:.1f}x  {} {}  {} KiB \033[K", "",
               filled, "", kBarWidth - filled, framesDone, frames_, rate, speed, last ? "took" : "ETA",
               clockText(last ? elapsed : remaining), bytes / 1024);
    lineOpen_ = !last;
    if (last) std::fputc('\n', stream_);
  }
  std::fflush(stream_);
}

} // namespace offstage
