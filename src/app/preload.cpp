#include "src/app/preload.h"

#include "render/output/codecs.h"
#include "render/output/output_kind.h"
#include "render/raster/context.h"

namespace offstage {

std::future<void> preloadLibraries(const std::filesystem::path& out) {
  prepareGl(); // here: it sets what other threads may read
  // Deferred where the system allows no more threads.
  return std::async(std::launch::async | std::launch::deferred, [out] {
    try {
      if (!out.empty() && holdsSound(outputKind(out)))
        static_cast<void>(libavVersions()); // any call loads them
      preloadGl();
    } catch (...) { // a name of no output, no such library, no memory: found again where it can be said
    }
  });
}

} // namespace offstage
