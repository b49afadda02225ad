#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace offstage {

/// A whole file, device or pipe. Throws std::runtime_error that says why it cannot be read, without its name:
/// "is a folder", "No such file or directory", "is larger than N bytes", "is empty".
std::vector<std::uint8_t> readFileBytes(const std::filesystem::path& file, std::size_t limit);

} // namespace offstage
