#pragma once

#include <cstdint>
#include <filesystem>

namespace offstage {

/// What a finished animated picture must be.
struct ExpectedAnimation {
  const char* codec = ""; ///< FFmpeg's name: "gif", "apng"
  int width = 0;          ///< px
  int height = 0;         ///< px
  std::int64_t frames = 0;
};

/// Reopens the file, counts its frames and decodes the first and the last. Throws Error(Transient) when it
/// differs from what it must be; `name` is what messages call the file.
void verifyAnimation(const std::filesystem::path& file, const ExpectedAnimation& expected,
                     const std::filesystem::path& name);

} // namespace offstage
