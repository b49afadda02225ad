#pragma once

#include "src/scene/tolerance.h"

#include <filesystem>
#include <optional>

namespace CLI {
class App;
}

namespace offstage {

/// What a command line says of the tolerance: a file, and what replaces or adds to its values.
struct ToleranceOptions {
  std::optional<std::filesystem::path> file;
  Tolerance given;

  /// The tolerance in force: that of the file or, without one, of a tolerance.toml in `folder` if there is
  /// one; then what the command line gives. Throws SceneError for what is wrong with the file.
  [[nodiscard]] Tolerance in(const std::filesystem::path& folder) const;
};

/// Adds --tolerance, --max-channel, --max-differing, --max-ratio, --max-cluster, --flip-max, --ssim-min,
/// --ignore-antialiasing, --max-forgiven, --ignore, --mask, --strict-alpha.
void addToleranceOptions(CLI::App& app, ToleranceOptions& options);

} // namespace offstage
