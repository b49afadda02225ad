#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace offstage {

/// The whole of a text file, a pipe included. Throws SceneError about the file as a whole when it does not
/// exist, is a folder, may not be read, or holds more than `limit` bytes
/// (`what` names the kind of file in that message: "a scene").
std::string readTextFile(const std::filesystem::path& file, std::size_t limit, const std::string& what);

} // namespace offstage
