#include "src/scene/scene.h"
#include "src/sim/world.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

/// Any text either parses into a world that can be stepped or is refused with an Error; nothing else may
/// happen.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const offstage::Scene scene =
        offstage::parseScene({reinterpret_cast<const char*>(data), size}, "fuzz.toml");
    offstage::World world(scene.world);
    if (scene.world.substeps > 100 || scene.world.bodies.size() > 1000) return 0;
    while (world.frame() < scene.clock.steps() && world.frame() < 20)
      world.step(scene.clock.tick(world.frame() + 1));
  } catch (const offstage::Error&) {
    return 0;
  }
  return 0;
}
