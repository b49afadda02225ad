#pragma once

#include <optional>
#include <string>

namespace offstage {

/// A shared library loaded at run time, its symbols kept out of the program's (RTLD_LOCAL). It stays loaded
/// until the process ends: Mesa and LLVM register exit handlers that must not outlive their code.
class DynamicLibrary {
public:
  /// Nothing when the library cannot be loaded; `reason` then holds the loader's message.
  static std::optional<DynamicLibrary> open(const char* name, std::string& reason);

  /// A function by name, as its type; null when the library lacks it.
  template <typename Function>
  [[nodiscard]] Function function(const char* name) const {
    return reinterpret_cast<Function>(symbol(name));
  }

private:
  explicit DynamicLibrary(void* handle) : handle_(handle) {}
  [[nodiscard]] void* symbol(const char* name) const;
  void* handle_;
};

} // namespace offstage
