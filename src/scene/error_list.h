#pragma once

#include "src/scene/diagnostic.h"
#include "src/scene/limits.h"
#include "src/scene/toml_value.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace offstage {

/// Collects everything that is wrong with one scene file, so that one run tells it all.
class ErrorList {
public:
  explicit ErrorList(std::string file) : file_(std::move(file)) {}

  void add(std::uint32_t line, std::uint32_t column, std::string message);
  void add(const TomlValue& value, std::string message) { add(value.line, value.column, std::move(message)); }
  /// About the file as a whole or about the command line; comes before those with a line.
  void add(std::string message) { add(0, 0, std::move(message)); }
  /// Errors of another file that the scene names; they come after the scene's own.
  void add(const SceneError& errors);

  [[nodiscard]] std::size_t count() const { return diagnostics_.size(); }
  /// Whether there are so many errors that looking for more helps nobody.
  [[nodiscard]] bool full() const { return diagnostics_.size() >= kMaxDiagnostics; }

  /// Throws SceneError with all errors in the order of their lines, when there are any.
  void throwIfAny();

private:
  std::string file_;
  std::vector<Diagnostic> diagnostics_;
  std::vector<Diagnostic> ofOtherFiles_;
};

} // namespace offstage
