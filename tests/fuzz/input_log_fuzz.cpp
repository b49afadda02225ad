#include "src/scene/input_log.h"
#include "src/sim/error.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

/// Any text is a game whose events do not go back in time, or is refused with an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto log = offstage::InputLog::parse({reinterpret_cast<const char*>(data), size}, "fuzz.log");
    double before = 0.0;
    for (const offstage::InputEvent& event : log.events()) {
      if (!(event.time >= before)) __builtin_trap();
      before = event.time;
      if (!log.mouseAt(event.time).allFinite()) __builtin_trap();
      if (event.action == offstage::InputAction::KeyDown && log.presses(event.action, event.name).empty())
        __builtin_trap();
    }
  } catch (const offstage::Error&) {
    return 0;
  }
  return 0;
}
