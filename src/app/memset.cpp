// The program's own memset(), which its libraries call too: the dynamic linker takes the program's before the
// C library's. Memory that comes fresh from the system holds zeros, and zeros written there only take room
// and time.
//
// At 1920 × 1080 each encoder of libvpx zeroes 101 MB of tokens, of which the largest frame takes 8, and
// frames of 4.7 MB and 25 tables of 0.26 MB that it never uses with the settings here; with transparency
// there are two encoders. libavcodec zeroes 326 MB for the packets of FFV1, as large as the worst of all
// pictures. None of their settings changes that. MB of all processes (PSS) with one worker and with two, and
// CPU seconds with two (medians of three in turns), for 48 frames of 1000 circles, without this file and with
// it; the files are the same to the byte:
//   .webm, draft                          302  504   2.52      181  260   2.49
//   .webm, good                           303  505  17.5       185  268  17.2
//   .webm, transparent, draft             475  849   4.95      236  368   4.70
//   .webm, transparent, good                -    -     -       239  376  41.3
//   .mkv, transparent, lossless (FFV1)    465  823   3.85      146  194   3.69
#include "render/job/fresh_memory.h"

#include <cstddef>
#include <cstdint>
#include <unistd.h>

// AddressSanitizer brings its own.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define OFFSTAGE_KEEP_MEMSET
#endif
#endif
#if !defined(__SANITIZE_ADDRESS__) && !defined(OFFSTAGE_KEEP_MEMSET)

extern "C" {

// The C library's memset() by its other name (Linux Standard Base, Core, __memset_chk): `room` is how much
// may be written.
// NOLINTNEXTLINE(bugprone-reserved-identifier)
void* __memset_chk(void* to, int value, std::size_t size, std::size_t room);

void* memset(void* to, int value, std::size_t size) noexcept {
  // Volatile, else the compiler knows both functions and makes a call of this one of it.
  static void* (*const volatile kWrite)(void*, int, std::size_t, std::size_t) = __memset_chk;
  // malloc() takes no less from the system by itself: workers.cpp keeps it so.
  constexpr std::size_t kLarge = std::size_t{1} << 17U;
  if (value != 0 || size < kLarge) return kWrite(to, value, size, size);

  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  auto* const begin = static_cast<std::uint8_t*>(to);
  const std::size_t head = (page - reinterpret_cast<std::uintptr_t>(begin) % page) % page;
  const std::size_t inner = (size - head) / page * page;
  if (!offstage::isFreshMemory(begin + head, inner)) return kWrite(to, value, size, size);
  kWrite(begin, 0, head, head);
  kWrite(begin + head + inner, 0, size - head - inner, size - head - inner);
  return to;
}

} // extern "C"

#endif
