#pragma once

#include "render/raster/context.h"

#include <memory>
#include <string>

namespace offstage {

inline constexpr const char* kOsMesaLibrary = "libOSMesa.so.8";

/// An OSMesa context (libOSMesa.so.8: Debian's libosmesa6; gone from Mesa since 25.1). Null when the library
/// is missing or gives no such context; `reason` then says why.
std::unique_ptr<GlContext> makeOsMesaContext(std::string& reason);

/// An EGL context on Mesa's surfaceless platform (EGL_MESA_platform_surfaceless), which draws with llvmpipe.
/// Null as above.
std::unique_ptr<GlContext> makeEglContext(std::string& reason);

/// An EGL context on the first graphics processor that gives one (EGL_EXT_platform_device); software devices
/// are passed over. Null as above.
std::unique_ptr<GlContext> makeEglDeviceContext(std::string& reason);

} // namespace offstage
