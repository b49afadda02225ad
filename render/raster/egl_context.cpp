#include "render/raster/backends.h"
#include "render/raster/dynamic_library.h"

#include <array>

#define EGL_NO_PLATFORM_SPECIFIC_TYPES // no X11 headers
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

namespace offstage {
namespace {

/// libEGL's functions; all of them are in EGL 1.5, which Debian's libEGL has had since 2016.
struct EglFunctions {
  decltype(&eglGetPlatformDisplay) getPlatformDisplay = nullptr;
  decltype(&eglInitialize) initialize = nullptr;
  decltype(&eglBindAPI) bindApi = nullptr;
  decltype(&eglChooseConfig) chooseConfig = nullptr;
  decltype(&eglCreateContext) createContext = nullptr;
  decltype(&eglDestroyContext) destroyContext = nullptr;
  decltype(&eglMakeCurrent) makeCurrent = nullptr;
  decltype(&eglGetProcAddress) getProcAddress = nullptr;
  decltype(&eglGetError) getError = nullptr;

  explicit EglFunctions(const DynamicLibrary& library) {
    load(library, getPlatformDisplay, "eglGetPlatformDisplay");
    load(library, initialize, "eglInitialize");
    load(library, bindApi, "eglBindAPI");
    load(library, chooseConfig, "eglChooseConfig");
    load(library, createContext, "eglCreateContext");
    load(library, destroyContext, "eglDestroyContext");
    load(library, makeCurrent, "eglMakeCurrent");
    load(library, getProcAddress, "eglGetProcAddress");
    load(library, getError, "eglGetError");
  }
  const char* missing = nullptr; ///< a function that the library lacks

private:
  template <typename Function>
  void load(const DynamicLibrary& library, Function& function, const char* name) {
    function = library.function<Function>(name);
    if (function == nullptr) missing = name;
  }
};

/// The display stays initialised until the process ends: there is one a process, and ending it would unload
/// the driver.
class EglContext final : public GlContext {
public:
  explicit EglContext(const EglFunctions& egl) : egl_(egl) {}

  ~EglContext() override {
    if (display_ == EGL_NO_DISPLAY) return;
    egl_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) egl_.destroyContext(display_, context_);
  }

  /// Makes display and context, and the context current. False, with a reason, when a step fails.
  bool start(std::string& reason) {
    const auto failed = [&](const char* step) {
      reason = fmt::format("{} fails (EGL error 0x{:04x})", step, egl_.getError());
      return false;
    };
    const EGLDisplay display =
        egl_.getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY) return failed("eglGetPlatformDisplay (surfaceless)");
    if (egl_.initialize(display, nullptr, nullptr) != EGL_TRUE) return failed("eglInitialize");
    display_ = display;
    if (egl_.bindApi(EGL_OPENGL_API) != EGL_TRUE) return failed("eglBindAPI(EGL_OPENGL_API)");
    const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (egl_.chooseConfig(display, wanted.data(), &config, 1, &count) != EGL_TRUE || count < 1) {
      return failed("eglChooseConfig");
    }
    const std::array<EGLint, 7> version{EGL_CONTEXT_MAJOR_VERSION,
                                        3,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        3,
                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                        EGL_NONE};
    context_ = egl_.createContext(display, config, EGL_NO_CONTEXT, version.data());
    if (context_ == EGL_NO_CONTEXT) return failed("eglCreateContext (OpenGL 3.3 core)");
    if (egl_.makeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
      return failed("eglMakeCurrent (without a surface)");
    }
    return true;
  }

  [[nodiscard]] Proc proc(const char* name) const override { return egl_.getProcAddress(name); }
  [[nodiscard]] std::string backend() const override { return "egl"; }

private:
  EglFunctions egl_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

} // namespace

std::unique_ptr<GlContext> makeEglContext(std::string& reason) {
  const auto library = DynamicLibrary::open("libEGL.so.1", reason);
  if (!library) return nullptr;
  const EglFunctions egl(*library);
  if (egl.missing != nullptr) {
    reason = fmt::format("libEGL.so.1 is too old: it lacks {}", egl.missing);
    return nullptr;
  }
  auto context = std::make_unique<EglContext>(egl);
  if (!context->start(reason)) return nullptr;
  return context;
}

} // namespace offstage
