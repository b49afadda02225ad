#include "render/draw/formula_cache.h"

#include "render/draw/file_bytes.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <stdexcept>
#include <string_view>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>
#include <xxhash.h>

namespace offstage {
namespace {

constexpr std::size_t kLargestEntry = 64UL << 20U;

std::filesystem::path defaultFolder() {
  const auto variable = [](const char* name) -> std::filesystem::path {
    const char* value = std::getenv(name); // NOLINT(concurrency-mt-unsafe)
    return value != nullptr ? value : "";
  };
  // As the XDG Base Directory Specification has it, a relative path does not count.
  if (const auto cache = variable("XDG_CACHE_HOME"); cache.is_absolute())
    return cache / "offstage" / "formulas";
  if (const auto home = variable("HOME"); home.is_absolute())
    return home / ".cache" / "offstage" / "formulas";
  return {};
}

/// What stands before the mask's bytes.
std::string headOf(const std::string& content, int width, int height) {
  return fmt::format("offstage formula 1\n{} {} {}\n{}\n", content.size(), width, height, content);
}

} // namespace

FormulaCache::FormulaCache() : folder_(defaultFolder()) {}

std::filesystem::path FormulaCache::fileOf(const std::string& content) const {
  const XXH128_hash_t hash = XXH3_128bits(content.data(), content.size());
  return folder_ / fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::optional<Mask> FormulaCache::find(const std::string& content) const {
  if (folder_.empty()) return std::nullopt;
  std::vector<std::uint8_t> bytes;
  try {
    bytes = readFileBytes(fileOf(content), kLargestEntry);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
  const std::string start(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(
                                                             bytes.size(), content.size() + 100)));
  std::size_t size = 0;
  Mask mask;
  if (std::sscanf(start.c_str(), "offstage formula 1\n%zu %d %d\n", &size, &mask.width, &mask.height) != 3)
    return std::nullopt;
  const std::string head = headOf(content, mask.width, mask.height);
  if (mask.empty() || !start.starts_with(head)) return std::nullopt;
  const auto pixels = static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height);
  if (bytes.size() != head.size() + pixels) return std::nullopt;
  mask.coverage.assign(bytes.begin() + static_cast<std::ptrdiff_t>(head.size()), bytes.end());
  return mask;
}

void FormulaCache::put(const std::string& content, const Mask& mask) const {
  if (folder_.empty()) return;
  std::error_code failed;
  std::filesystem::create_directories(folder_, failed);
  if (failed) return;
  std::string name = (folder_ / "new-XXXXXX").string();
  const int file = mkstemp(name.data());
  if (file < 0) return;
  std::string bytes = headOf(content, mask.width, mask.height);
  bytes.append(mask.coverage.begin(), mask.coverage.end());
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t more = write(file, bytes.data() + written, bytes.size() - written);
    if (more <= 0) break;
    written += static_cast<std::size_t>(more);
  }
  const bool whole = written == bytes.size() && close(file) == 0;
  if (whole) std::filesystem::rename(name, fileOf(content), failed);
  if (!whole || failed) std::filesystem::remove(name, failed);
}

} // namespace offstage
