#pragma once

#include "src/scene/error_list.h"
#include "src/scene/tolerance.h"
#include "src/scene/toml_value.h"

#include <filesystem>
#include <span>
#include <string_view>

namespace offstage {

/// The keys of a tolerance, as tolerance.toml has them: max_channel, max_pixels, …
std::span<const std::string_view> toleranceKeys();

/// Takes one `key = value` of a tolerance; false when the key is none of toleranceKeys(). What is wrong with
/// the value goes to `errors`. Mask files are looked for in `folder`.
bool readToleranceEntry(const TomlEntry& entry, const std::filesystem::path& folder, Tolerance& tolerance,
                        ErrorList& errors);

/// Reads a tolerance.toml. Throws SceneError with every error of the file, located; unknown keys are errors.
Tolerance loadTolerance(const std::filesystem::path& file);

} // namespace offstage
