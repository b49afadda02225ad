#include "src/scene/limits.h"
#include "src/scene/replay.h"
#include "src/scene/trace_compare.h"
#include "src/sim/error.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

/// Any text is a trace that is the same as itself and can be replayed, or is refused with an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const offstage::Trace trace =
        offstage::parseTrace({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
    for (const auto match : {offstage::TraceMatch::Id, offstage::TraceMatch::Nearest}) {
      const offstage::TraceComparison comparison = offstage::compareTraces(trace, trace, {}, match);
      if (match == offstage::TraceMatch::Id && !comparison.same) __builtin_trap();
      static_cast<void>(offstage::describe(comparison));
    }
    if (trace.frames.empty()) return 0;
    if (trace.frames.back().time - trace.frames.front().time > offstage::kMaxDuration) return 0;
    const auto frames = offstage::replayFrames(trace, std::nullopt);
    if (offstage::replayClock(frames, true).steps() + 1 != static_cast<std::int64_t>(frames.size()))
      __builtin_trap();
  } catch (const offstage::Error&) {
    return 0;
  }
  return 0;
}
