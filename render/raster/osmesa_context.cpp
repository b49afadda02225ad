#include "render/raster/backends.h"
#include "render/raster/dynamic_library.h"

#include <array>
#include <cstdint>

#include <GL/osmesa.h>

#if defined(__SANITIZE_ADDRESS__)
#define OFFSTAGE_WITH_LEAK_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define OFFSTAGE_WITH_LEAK_SANITIZER
#endif
#endif
#ifdef OFFSTAGE_WITH_LEAK_SANITIZER
/// Read by LeakSanitizer. OSMesa keeps what it makes for a context's window (480 bytes) when the context
/// goes, and what LLVM and EGL keep until the process ends is theirs too.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() { // NOLINT(bugprone-reserved-identifier)
  return "leak:libOSMesa.so\nleak:libEGL\nleak:swrast_dri.so\nleak:libLLVM\n";
}
#endif

namespace offstage {
namespace {

class OsMesaContext final : public GlContext {
public:
  OsMesaContext(DynamicLibrary library, OSMesaContext context) : library_(library), context_(context) {}

  ~OsMesaContext() override {
    const auto makeCurrent = library_.function<decltype(&OSMesaMakeCurrent)>("OSMesaMakeCurrent");
    const auto destroy = library_.function<decltype(&OSMesaDestroyContext)>("OSMesaDestroyContext");
    makeCurrent(nullptr, nullptr, 0, 0, 0);
    destroy(context_);
  }

  bool makeCurrent() {
    const auto function = library_.function<decltype(&OSMesaMakeCurrent)>("OSMesaMakeCurrent");
    return function != nullptr &&
           function(context_, window_.data(), GL_UNSIGNED_BYTE, kWindowSize, kWindowSize) == GL_TRUE;
  }

  [[nodiscard]] Proc proc(const char* name) const override {
    return library_.function<decltype(&OSMesaGetProcAddress)>("OSMesaGetProcAddress")(name);
  }
  [[nodiscard]] std::string backend() const override { return "osmesa"; }

private:
  static constexpr int kWindowSize = 16;
  DynamicLibrary library_;
  OSMesaContext context_;
  /// OSMesa asks for a window's memory; the canvas draws into a framebuffer object of its own.
  std::array<std::uint8_t, 4UL * kWindowSize * kWindowSize> window_{};
};

} // namespace

std::unique_ptr<GlContext> makeOsMesaContext(std::string& reason) {
  const auto library = DynamicLibrary::open(kOsMesaLibrary, reason);
  if (!library) return nullptr;
  const auto create = library->function<decltype(&OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs");
  if (create == nullptr || library->function<void*>("OSMesaMakeCurrent") == nullptr ||
      library->function<void*>("OSMesaDestroyContext") == nullptr ||
      library->function<void*>("OSMesaGetProcAddress") == nullptr) {
    reason = "libOSMesa.so.8 is too old: it lacks OSMesaCreateContextAttribs";
    return nullptr;
  }
  const std::array<int, 15> attributes{OSMESA_FORMAT,
                                       OSMESA_RGBA,
                                       OSMESA_DEPTH_BITS,
                                       0,
                                       OSMESA_STENCIL_BITS,
                                       0,
                                       OSMESA_ACCUM_BITS,
                                       0,
                                       OSMESA_PROFILE,
                                       OSMESA_COMPAT_PROFILE,
                                       OSMESA_CONTEXT_MAJOR_VERSION,
                                       3,
                                       OSMESA_CONTEXT_MINOR_VERSION,
                                       3,
                                       0};
  const OSMesaContext handle = create(attributes.data(), nullptr);
  if (handle == nullptr) {
    reason = "OSMesa gives no OpenGL 3.3 context of the compatibility profile";
    return nullptr;
  }
  auto context = std::make_unique<OsMesaContext>(*library, handle);
  if (!context->makeCurrent()) {
    reason = "OSMesa does not make its context current";
    return nullptr;
  }
  return context;
}

} // namespace offstage
