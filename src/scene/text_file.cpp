#include "src/scene/text_file.h"

#include "src/scene/diagnostic.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include <fmt/core.h>

namespace offstage {

std::string readTextFile(const std::filesystem::path& file, std::size_t limit, const std::string& what) {
  const auto fail = [&file](const std::string& problem) { throw SceneError(file.string(), problem); };
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) fail(fmt::format("this is a folder, not {}", what));

  struct Close {
    void operator()(std::FILE* stream) const { static_cast<void>(std::fclose(stream)); }
  };
  const std::unique_ptr<std::FILE, Close> stream(std::fopen(file.c_str(), "rb"));
  if (!stream) fail(fmt::format("cannot be read: {}", std::system_category().message(errno)));

  std::string text;
  char block[65536];
  // Reads on until the end instead of asking for the size: a pipe has none, and a device may have no end.
  while (text.size() <= limit) {
    const std::size_t got = std::fread(block, 1, sizeof block, stream.get());
    text.append(block, got);
    if (got == 0) break;
  }
  if (std::ferror(stream.get()) != 0) {
    fail(fmt::format("cannot be read: {}", std::system_category().message(errno)));
  }
  if (text.size() > limit) fail(fmt::format("{} may hold at most {} bytes", what, limit));
  return text;
}

} // namespace offstage
