#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace offstage {

/// Reads a dt log: one frame duration in whole nanoseconds a line; empty lines and lines that start with '#'
/// are skipped. When the first line is `# now`, the lines are raw timestamps of handle(now) instead: the
/// first is time 0 and each further one ends a frame; they must not go back. Returns the durations in ns
/// (each ≥ 0, at least one). Throws SceneError with file:line:column for every line that is not such a
/// number.
std::vector<std::int64_t> readDtLog(const std::filesystem::path& file);

/// The same from text; `file` is used in messages.
std::vector<std::int64_t> parseDtLog(std::string_view text, const std::filesystem::path& file);

} // namespace offstage
