#include "src/scene/dt_log.h"
#include "src/sim/clock.h"
#include "src/sim/error.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

/// Any text is a clock that does not go back, or is refused with an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto durations = offstage::parseDtLog({reinterpret_cast<const char*>(data), size}, "fuzz.dt");
    const offstage::Clock clock = offstage::Clock::recorded(durations);
    for (std::int64_t frame = 1; frame <= clock.steps(); ++frame)
      if (clock.time(frame) < clock.time(frame - 1)) __builtin_trap();
  } catch (const offstage::Error&) {
    return 0;
  }
  return 0;
}
