#pragma once

#include "render/compare/report.h"

#include <exception>
#include <filesystem>
#include <string>

namespace offstage {

/// The result of `work`. When that throws and `junit` names a file, the file says so (writeJunitError())
/// before the exception goes on, whatever becomes of the file: the exception is what went wrong first.
template <typename Work>
auto withJunit(const std::filesystem::path& junit, const std::string& suite, const std::string& title,
               const Work& work) {
  try {
    return work();
  } catch (const std::exception& problem) {
    if (!junit.empty()) {
      try {
        writeJunitError(junit, suite, title, problem.what());
      } catch (const std::exception&) { // its place is no good, which is not what the run failed of
      }
    }
    throw;
  }
}

} // namespace offstage
