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

bool DynamicLibrary::lackedMemory(std::string_view reason) {
  // glibc names the error behind the second, but leaves it out where memory is short.
  return reason.find("annot allocate memory") != std::string_view::npos ||
         reason.ends_with("failed to map segment from shared object");
}

void* DynamicLibrary::symbol(const char* name) const {
  return dlsym(handle_, name);
}

} // namespace offstage
