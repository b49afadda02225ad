#include "render/job/warning_log.h"

#include "render/job/console.h"
#include "src/scene/diagnostic.h"

#include <cstdio>
#include <new>
#include <sys/mman.h>
#include <utility>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr std::size_t kBytes = kWarningKinds * sizeof(std::atomic<bool>);

} // namespace

WarningLog::WarningLog(Mode mode) : mode_(mode) {
  // Fresh anonymous memory is zero: nothing has been told.
  void* memory = mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  told_ = static_cast<std::atomic<bool>*>(memory);
}

WarningLog::~WarningLog() {
  munmap(told_, kBytes);
}

void WarningLog::report(const Warning& warning, const WarningText& text) {
  const std::string what = text.of(warning);
  const std::string file = text.file().empty() ? "offstage" : text.file();
  if (mode_ == Mode::Strict) throw SceneError(file, what + " (--strict)");
  if (told_[warning.what.index()].exchange(true)) return;
  // Over the bar of a render, which is drawn anew below.
  const int columns = terminalColumns(stderr);
  const std::string clear = columns > 0 ? fmt::format("\r{:{}}\r", "", columns - 1) : "";
  say(stderr, fmt::format("{}{}: warning: {}\n", clear, file, what));
}

WatchedRun::WatchedRun(const World& world, WarningText text, WarningLog& log)
    : watch_(world), text_(std::move(text)), log_(&log) {}

void WatchedRun::step(World& world, const Tick& tick) {
  for (const Warning& warning : watch_.step(world, tick))
    if (!text_.isExpected(warning)) log_->report(warning, text_);
}

} // namespace offstage
