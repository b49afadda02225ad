#include "render/compare/golden_states.h"
#include "src/scene/tolerance_file.h"
#include "src/sim/error.h"
#include "tests/fuzz/memory_file.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

/// Any file beside goldens is one of states with a hash a frame, or of a tolerance, or is refused with an
/// Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto states =
        offstage::parseGoldenStates({reinterpret_cast<const char*>(data), size}, "fuzz.states");
    if (states.stride < 1 || states.hashes.empty()) __builtin_trap();
  } catch (const offstage::Error&) { // refused
  }
  try {
    const offstage::fuzz::MemoryFile file(data, size);
    static_cast<void>(offstage::loadTolerance(file.path()));
  } catch (const offstage::Error&) { // refused
  }
  return 0;
}
