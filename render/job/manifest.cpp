#include "render/job/manifest.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <system_error>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr std::string_view kFirstLine = "offstage parts 1";
constexpr std::string_view kFirstWords = "offstage parts "; ///< of every version
constexpr std::string_view kEquals = " = ";

} // namespace

void Manifest::add(std::string_view key, std::string_view value) {
  std::string oneLine(value);
  std::ranges::replace(oneLine, '\n', ' ');
  entries_.emplace_back(key, std::move(oneLine));
}

std::string Manifest::text() const {
  std::string text = fmt::format("{}\n", kFirstLine);
  for (const auto& [key, value] : entries_) text += fmt::format("{}{}{}\n", key, kEquals, value);
  return text;
}

std::vector<std::string> Manifest::values(std::string_view key) const {
  std::vector<std::string> found;
  for (const auto& [name, value] : entries_)
    if (name == key) found.push_back(value);
  return found;
}

std::string Manifest::differences(const Manifest& other) const {
  std::vector<std::string> keys;
  for (const Manifest* manifest : {this, &other}) {
    for (const auto& entry : manifest->entries_) {
      if (std::ranges::count(keys, entry.first) == 0 && values(entry.first) != other.values(entry.first))
        keys.push_back(entry.first);
    }
  }
  std::string text;
  for (const std::string& key : keys) text += fmt::format("{}the {}", text.empty() ? "" : ", ", key);
  return text;
}

std::optional<Manifest> Manifest::parse(std::string_view text) {
  std::istringstream lines{std::string(text)};
  std::string line;
  if (!std::getline(lines, line) || line != kFirstLine) return std::nullopt;
  Manifest manifest;
  while (std::getline(lines, line)) {
    const std::size_t equals = line.find(kEquals);
    if (equals == std::string::npos) return std::nullopt;
    manifest.add(line.substr(0, equals), line.substr(equals + kEquals.size()));
  }
  return manifest;
}

std::optional<Manifest> Manifest::read(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return std::nullopt; // a pipe would hang
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  std::ostringstream text;
  text << stream.rdbuf();
  return parse(text.str());
}

bool Manifest::isForeign(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  std::ifstream stream(file, std::ios::binary);
  std::string beginning(kFirstWords.size(), '\0');
  stream.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(stream.gcount()));
  return !kFirstWords.starts_with(beginning);
}

} // namespace offstage
