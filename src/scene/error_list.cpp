#include "src/scene/error_list.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace offstage {

void ErrorList::add(std::uint32_t line, std::uint32_t column, std::string message) {
  if (!full()) diagnostics_.push_back({{file_, line, column}, std::move(message)});
}

void ErrorList::add(const SceneError& errors) {
  ofOtherFiles_.insert(ofOtherFiles_.end(), errors.diagnostics().begin(), errors.diagnostics().end());
}

void ErrorList::throwIfAny() {
  std::stable_sort(diagnostics_.begin(), diagnostics_.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::tie(a.where.line, a.where.column) < std::tie(b.where.line, b.where.column);
  });
  diagnostics_.insert(diagnostics_.end(), ofOtherFiles_.begin(), ofOtherFiles_.end());
  ofOtherFiles_.clear();
  if (diagnostics_.empty()) return;
  throw SceneError(std::move(diagnostics_));
}

} // namespace offstage
