#include "src/app/preload.h"

#include "render/output/codecs.h"
#include "render/output/output_kind.h"
#include "render/raster/context.h"
#include "src/sim/error.h"

namespace offstage {

std::future<void> preloadLibraries(const std::filesystem::path& out) {
  prepareGl(); // here: it sets what other threads may read
  // Deferred where the system allows no more threads.
  return std::async(std::launch::async | std::launch::deferred, [out] {
    try {
      if (!out.empty() && holdsSound(outputKind(out)))
        static_cast<void>(libavVersions()); // any call loads them
      preloadGl();
    } catch (const Error&) { // a name of no output, or no such library: found again where it can be said
    }
  });
}

} // namespace offstage
