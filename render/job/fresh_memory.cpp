#include "render/job/fresh_memory.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <fcntl.h>
#include <sys/mman.h>
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

/// Whether the range, of which no page is there, is all private and of no file. For such memory alone
/// MADV_FREE succeeds (man 2 madvise); without pages it changes nothing. /proc/self/maps would say it, too,
/// but with hundreds of libraries it takes up to half a millisecond to read.
bool isPrivateAnonymous(const Range& range) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): an address, as the caller gave it
  return madvise(reinterpret_cast<void*>(range.begin), range.end - range.begin, MADV_FREE) == 0;
}

} // namespace

bool isFreshMemory(const void* begin, std::size_t bytes) noexcept {
  const int error = errno;
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const Range range{address / page * page, (address + bytes + page - 1) / page * page};
  const bool fresh = bytes >= page && isUntouched(range, page) && isPrivateAnonymous(range);
  errno = error;
  return fresh;
}

} // namespace offstage
