#include "render/raster/backends.h"
#include "render/raster/dynamic_library.h"

#include <array>
#include <string_view>
#include <vector>

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
  decltype(&eglQueryString) queryString = nullptr;

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
    load(library, queryString, "eglQueryString");
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

  /// Opens a display of `platform`, makes a context, and the context current. False, with a reason, when a
  /// step fails. `native`: as eglGetPlatformDisplay has it; `name`: of the backend.
  bool start(EGLenum platform, void* native, std::string_view name, std::string& reason) {
    const auto failed = [&](const char* step) {
      reason = fmt::format("{} fails (EGL error 0x{:04x})", step, egl_.getError());
      return false;
    };
    name_ = name;
    const EGLDisplay display = egl_.getPlatformDisplay(platform, native, nullptr);
    if (display == EGL_NO_DISPLAY) return failed("eglGetPlatformDisplay");
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
                                        EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
                                        EGL_NONE};
    context_ = egl_.createContext(display, config, EGL_NO_CONTEXT, version.data());
    if (context_ == EGL_NO_CONTEXT) return failed("eglCreateContext (OpenGL 3.3, compatibility profile)");
    if (egl_.makeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
      return failed("eglMakeCurrent (without a surface)");
    }
    return true;
  }

  [[nodiscard]] Proc proc(const char* name) const override { return egl_.getProcAddress(name); }
  [[nodiscard]] std::string backend() const override { return name_; }

private:
  EglFunctions egl_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
  std::string name_;
};

/// libEGL's functions, or null with a reason.
std::unique_ptr<EglFunctions> loadEgl(std::string& reason) {
  const auto library = DynamicLibrary::open("libEGL.so.1", reason);
  if (!library) return nullptr;
  auto egl = std::make_unique<EglFunctions>(*library);
  if (egl->missing == nullptr) return egl;
  reason = fmt::format("libEGL.so.1 is too old: it lacks {}", egl->missing);
  return nullptr;
}

bool lists(const char* extensions, std::string_view name) {
  const std::string_view all = extensions != nullptr ? extensions : "";
  for (std::size_t at = all.find(name); at != std::string_view::npos; at = all.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || all[at - 1] == ' ') && (end == all.size() || all[end] == ' ')) return true;
  }
  return false;
}

/// The devices that are not software (EGL_EXT_device_enumeration, EGL_EXT_device_query).
std::vector<EGLDeviceEXT> hardwareDevices(const EglFunctions& egl) {
  const auto queryDevices =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.getProcAddress("eglQueryDevicesEXT"));
  const auto queryDeviceString =
      reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(egl.getProcAddress("eglQueryDeviceStringEXT"));
  if (queryDevices == nullptr || queryDeviceString == nullptr) return {};
  EGLint count = 0;
  if (queryDevices(0, nullptr, &count) != EGL_TRUE || count <= 0) return {};
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (queryDevices(count, devices.data(), &count) != EGL_TRUE) return {};
  devices.resize(static_cast<std::size_t>(count));
  std::erase_if(devices, [&](EGLDeviceEXT device) {
    return lists(queryDeviceString(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
  });
  return devices;
}

} // namespace

std::unique_ptr<GlContext> makeEglContext(std::string& reason) {
  const auto egl = loadEgl(reason);
  if (egl == nullptr) return nullptr;
  auto context = std::make_unique<EglContext>(*egl);
  if (!context->start(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, "egl", reason)) return nullptr;
  return context;
}

std::unique_ptr<GlContext> makeEglDeviceContext(std::string& reason) {
  const auto egl = loadEgl(reason);
  if (egl == nullptr) return nullptr;
  if (!lists(egl->queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_EXT_platform_device")) {
    reason = "libEGL has no EGL_EXT_platform_device";
    return nullptr;
  }
  reason = "no graphics processor with an EGL driver is here";
  for (EGLDeviceEXT device : hardwareDevices(*egl)) {
    auto context = std::make_unique<EglContext>(*egl);
    if (context->start(EGL_PLATFORM_DEVICE_EXT, device, "egl-device", reason)) return context;
  }
  return nullptr;
}

} // namespace offstage
