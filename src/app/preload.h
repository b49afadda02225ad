#pragma once

#include <filesystem>
#include <future>

namespace offstage {

/// Begins to load the libraries that `out` will be made with, in a thread of its own, while the scene is
/// read: Mesa, and for a video FFmpeg's. Together they take as long as a scene of some thousand bodies (45
/// ms). Wait for it before a process is forked. What is missing is told by whoever needs it.
std::future<void> preloadLibraries(const std::filesystem::path& out);

} // namespace offstage
