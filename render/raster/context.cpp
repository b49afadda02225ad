#include "render/raster/context.h"

#include "render/raster/backends.h"
#include "render/raster/dynamic_library.h"
#include "src/sim/error.h"

#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr const char* kDriver = "llvmpipe";

/// Mesa 22.3 crashes while it compiles shaders for vectors of 512 bits, on any processor. Fewer bits give the
/// same pixels.
void limitVectorWidth() {
  const char* width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
  if (width != nullptr && std::atoi(width) > 256) setenv("LP_NATIVE_VECTOR_WIDTH", "256", 1);
}

/// Mesa reads these once, when its driver starts. A user's own setting wins.
void setMesaDefaults() {
  limitVectorWidth();
  setenv("LP_NUM_THREADS", "0", 0);        // llvmpipe's own threads: parallelism is processes here
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0); // EGL must not pick a GPU's driver: other pixels
  setenv("GALLIUM_DRIVER", kDriver, 0);
}

constexpr std::string_view kInstallHint =
    "install libosmesa6, or libegl1 libegl-mesa0 libgl1-mesa-dri (apt-get install ...)";

std::string_view wantedBackend() {
  const char* setting = std::getenv("OFFSTAGE_GL");
  return setting == nullptr || *setting == '\0' ? "auto" : setting;
}

} // namespace

std::string glDriver() {
  if (wantedBackend() == "egl-device") return "egl-device";
  const char* driver = std::getenv("GALLIUM_DRIVER");
  return driver == nullptr || *driver == '\0' ? kDriver : driver;
}

bool prepareGl() {
  if (wantedBackend() != "auto" && wantedBackend() != "osmesa") return false;
  setMesaDefaults();
  return true;
}

void preloadGl() {
  if (!prepareGl()) return;
  std::string reason; // whoever makes a context will hear it
  static_cast<void>(DynamicLibrary::open(kOsMesaLibrary, reason));
}

std::unique_ptr<GlContext> makeGlContext() {
  const std::string_view wanted = wantedBackend();
  if (wanted != "auto" && wanted != "osmesa" && wanted != "egl" && wanted != "egl-device") {
    throw Error(ExitCode::BadInput,
                fmt::format("OFFSTAGE_GL is '{}'; it may be osmesa, egl, egl-device or auto", wanted));
  }
  if (wanted == "egl-device") {
    std::string reason;
    if (auto context = makeEglDeviceContext(reason)) return context;
    throw Error(
        ExitCode::Environment,
        fmt::format(
            "OFFSTAGE_GL=egl-device finds nothing to draw with: {}; install its driver (libegl-nvidia0 "
            "for NVIDIA, libegl-mesa0 and libgl1-mesa-dri for others), or leave OFFSTAGE_GL unset",
            reason));
  }
  setMesaDefaults();
  std::string reasons;
  bool shortOfMemory = false;
  const auto attempt = [&](std::string_view name, auto make) -> std::unique_ptr<GlContext> {
    if (wanted != "auto" && wanted != name) return nullptr;
    std::string reason;
    std::unique_ptr<GlContext> context = make(reason);
    if (context == nullptr) reasons += fmt::format("\n  {}: {}", name, reason);
    shortOfMemory = shortOfMemory || (context == nullptr && DynamicLibrary::lackedMemory(reason));
    return context;
  };
  if (auto context = attempt("osmesa", makeOsMesaContext)) return context;
  if (auto context = attempt("egl", makeEglContext)) return context;
  if (shortOfMemory) {
    throw Error(
        ExitCode::Transient,
        fmt::format("there is no memory to load OpenGL: raise the limit (ulimit -v), or end something{}",
                    reasons));
  }
  throw Error(ExitCode::Environment, fmt::format("no OpenGL to draw with: {}{}", kInstallHint, reasons));
}

} // namespace offstage
