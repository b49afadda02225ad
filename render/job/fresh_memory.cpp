#include "render/job/fresh_memory.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <fcntl.h>
#include <fstream>
#include <string>
#include <string_view>
#include <unistd.h>

namespace offstage {
namespace {

struct Range {
  std::uintptr_t begin = 0;
  std::uintptr_t end = 0;
};

/// Whether no page of the range has ever been there. /proc/self/pagemap holds a word a page; bit 63: in
/// memory, bit 62: swapped out (Linux, Documentation/admin-guide/mm/pagemap.rst).
bool isUntouched(const Range& range, std::uintptr_t page) {
  const int file = open("/proc/self/pagemap", O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  std::array<std::uint64_t, 512> entries{};
  std::uintptr_t next = range.begin / page;
  const std::uintptr_t end = range.end / page;
  bool untouched = true;
  while (untouched && next < end) {
    const auto wanted = std::min<std::uintptr_t>(entries.size(), end - next) * sizeof(std::uint64_t);
    const ssize_t got = pread(file, entries.data(), wanted, static_cast<off_t>(next * sizeof(std::uint64_t)));
    untouched = got == static_cast<ssize_t>(wanted) &&
                std::all_of(entries.begin(), entries.begin() + wanted / sizeof(std::uint64_t),
                            [](std::uint64_t entry) { return entry >> 62U == 0; });
    next += wanted / sizeof(std::uint64_t);
  }
  close(file);
  return untouched;
}

/// A line of /proc/self/maps is `begin-end rwxp offset device inode [name]` (man 5 proc); what has no inode
/// and no name was made for this process alone.
bool isPrivateAnonymous(std::string_view line, Range& mapping) {
  const char* const end = line.data() + line.size();
  const std::from_chars_result first = std::from_chars(line.data(), end, mapping.begin, 16);
  if (first.ec != std::errc() || first.ptr == end) return false;
  const std::from_chars_result second = std::from_chars(first.ptr + 1, end, mapping.end, 16);
  if (second.ec != std::errc()) return false;
  const std::string_view rest(second.ptr, static_cast<std::size_t>(end - second.ptr));
  if (!rest.starts_with(" rw-p ")) return false;
  constexpr std::string_view kNoFile = " 00:00 0 ";
  const std::size_t at = rest.find(kNoFile);
  if (at == std::string_view::npos) return false;
  const std::size_t name = rest.find_first_not_of(' ', at + kNoFile.size());
  return name == std::string_view::npos || rest.substr(name) == "[heap]";
}

/// Whether private anonymous mappings cover the range; the file lists mappings in the order of their
/// addresses.
bool isPrivateAnonymous(Range range) {
  std::ifstream maps("/proc/self/maps");
  std::string line;
  while (range.begin < range.end && std::getline(maps, line)) {
    Range mapping;
    const bool anonymous = isPrivateAnonymous(line, mapping);
    if (mapping.end <= range.begin) continue;
    if (!anonymous || mapping.begin > range.begin) return false;
    range.begin = mapping.end;
  }
  return range.begin >= range.end;
}

} // namespace

bool isFreshMemory(const void* begin, std::size_t bytes) noexcept {
  const int error = errno;
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const Range range{address / page * page, (address + bytes + page - 1) / page * page};
  bool fresh = false;
  try {
    fresh = bytes >= page && isUntouched(range, page) && isPrivateAnonymous(range);
  } catch (...) { // no memory to read a line into
    fresh = false;
  }
  errno = error;
  return fresh;
}

} // namespace offstage
