#include "src/scene/scene.h"
#include "tests/fuzz/memory_file.h"

#include <cstddef>
#include <cstdint>
#include <string>

/// Any file is a table of bodies, one a row and all of them finite, or is refused with an Error; whether the
/// scene says the shape or the table.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const offstage::fuzz::MemoryFile file(data, size);
  for (const char* keys :
       {"", "shape = \"circle\"\nradius = 2\n", "shape = \"rectangle\"\nsize = [3, 4]\n"}) {
    try {
      const offstage::Scene scene =
          offstage::parseScene("[[bodies]]\ntable = \"" + file.path() + "\"\n" + keys, "fuzz.toml");
      for (const offstage::Body& body : scene.world.bodies)
        if (!body.position.allFinite() || !body.velocity.allFinite()) __builtin_trap();
    } catch (const offstage::Error&) { // refused
    }
  }
  return 0;
}
