#include "render/raster/dynamic_library.h"

#include <dlfcn.h>

namespace offstage {

std::optional<DynamicLibrary> DynamicLibrary::open(const char* name, std::string& reason) {
  void* handle = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
  if (handle == nullptr) {
    const char* message = dlerror();
    reason = message != nullptr ? message : name;
    return std::nullopt;
  }
  return DynamicLibrary(handle);
}

void* DynamicLibrary::symbol(const char* name) const {
  return dlsym(handle_, name);
}

} // namespace offstage
