#pragma once

#include "src/sim/error.h"

#include <cstdint>
#include <string>
#include <vector>

namespace offstage {

/// A place in a text file. Lines and columns count from 1; 0 means the file as a whole.
struct SourceLocation {
  std::string file;
  std::uint32_t line = 0;
  std::uint32_t column = 0;
};

/// One thing that is wrong with a user's file.
struct Diagnostic {
  SourceLocation where;
  std::string message; ///< names the key, what was given, what is allowed

  /// "file:line:column: error: message", the form that editors and CI logs make clickable.
  [[nodiscard]] std::string text() const;
};

/// Everything that is wrong with a file, in the order of its lines. what() holds one diagnostic's text() a
/// line.
class SceneError : public Error {
public:
  explicit SceneError(std::vector<Diagnostic> diagnostics);
  SceneError(std::string file, std::string message); ///< about the file as a whole
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const noexcept { return diagnostics_; }

private:
  std::vector<Diagnostic> diagnostics_;
};

} // namespace offstage
