#include "render/output/frame_pattern.h"

#include "render/output/file_error.h"
#include "src/sim/error.h"

#include <charconv>
#include <cstddef>

#include <fmt/format.h>

namespace offstage {

namespace {

/// More digits than a 64-bit number surely fills.
constexpr int kMostDigits = 18;

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

[[noreturn]] void refuse(const std::filesystem::path& pattern, std::string_view why) {
  throw Error(
      ExitCode::BadInput,
      fmt::format(
          "bad pattern {}: {}; write the frame number's place once, as in frames/%06d.png (and %% for a "
          "percent sign)",
          quoted(pattern), why));
}

} // namespace

FramePattern::FramePattern(const std::filesystem::path& pattern) : folder_(folderOf(pattern)) {
  const std::string name = pattern.filename().native();
  bool found = false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    std::string& side = found ? after_ : before_;
    if (name[i] != '%') {
      side += name[i];
      continue;
    }
    ++i;
    if (i < name.size() && name[i] == '%') {
      side += '%';
      continue;
    }
    const std::size_t begin = i;
    while (i < name.size() && isDigit(name[i])) ++i;
    const std::string_view width = std::string_view(name).substr(begin, i - begin);
    if (i == name.size() || name[i] != 'd') {
      refuse(pattern, fmt::format("'{}' is no place for a number", name.substr(begin - 1, i + 2 - begin)));
    }
    if (found) refuse(pattern, "it has more than one %d");
    found = true;
    if (width.empty()) continue;
    if (width.front() != '0') {
      refuse(pattern, fmt::format("%{}d would fill up with spaces, %0{}d fills up with zeros", width, width));
    }
    const auto [end, error] = std::from_chars(width.data(), width.data() + width.size(), digits_);
    if (error != std::errc() || digits_ < 1 || digits_ > kMostDigits) {
      refuse(pattern, fmt::format("%{}d does not have 1 to {} digits", width, kMostDigits));
    }
  }
  if (!found) refuse(pattern, "its file name has no %d");
}

std::filesystem::path FramePattern::path(std::int64_t number) const {
  return folder_ / fmt::format("{}{:0{}}{}", before_, number, digits_, after_);
}

std::optional<std::int64_t> FramePattern::numberOf(std::string_view name) const {
  if (name.size() < before_.size() + after_.size()) return std::nullopt;
  if (!name.starts_with(before_) || !name.ends_with(after_)) return std::nullopt;
  const std::string_view digits = name.substr(before_.size(), name.size() - before_.size() - after_.size());
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  // The way back is the test: it excludes "-1", too few digits and leading zeros too many.
  if (error != std::errc() || number < 0 || path(number).filename().native() != name) return std::nullopt;
  return number;
}

bool FramePattern::mayBeginWith(std::string_view begin) const {
  if (begin.size() <= before_.size()) return std::string_view(before_).starts_with(begin);
  if (!begin.starts_with(before_)) return false;
  begin.remove_prefix(before_.size());
  // What follows the number may begin with digits, too.
  for (int digits = 0; !begin.empty() && isDigit(begin.front()); begin.remove_prefix(1)) {
    ++digits;
    if (digits >= digits_ && std::string_view(after_).starts_with(begin.substr(1))) return true;
  }
  return begin.empty();
}

} // namespace offstage
