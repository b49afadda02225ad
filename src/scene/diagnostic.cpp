#include "src/scene/diagnostic.h"

#include <utility>

namespace offstage {
namespace {

std::string joined(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (!text.empty()) text += '\n';
    text += diagnostic.text();
  }
  return text;
}

} // namespace

std::string Diagnostic::text() const {
  std::string text = where.file;
  if (where.line > 0) text += ':' + std::to_string(where.line) + ':' + std::to_string(where.column);
  return text + ": error: " + message;
}

SceneError::SceneError(std::vector<Diagnostic> diagnostics)
    : Error(ExitCode::BadInput, joined(diagnostics)), diagnostics_(std::move(diagnostics)) {}

SceneError::SceneError(std::string file, std::string message)
    : Error(ExitCode::BadInput, file + ": error: " + message) {
  Diagnostic& diagnostic = diagnostics_.emplace_back();
  diagnostic.where.file = std::move(file);
  diagnostic.message = std::move(message);
}

} // namespace offstage
