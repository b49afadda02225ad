#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace offstage {

/// A shared library loaded at run time, its symbols kept out of the program's (RTLD_LOCAL). It stays loaded
/// until the process ends: Mesa and LLVM register exit handlers that must not outlive their code.
class DynamicLibrary {
public:
  /// Nothing when the library cannot be loaded; `reason` then holds the loader's message.
  static std::optional<DynamicLibrary> open(const char* name, std::string& reason);
  /// Whether the loader's message says that there was no memory for a library that is there.
  static bool lackedMemory(std::string_view reason);

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
