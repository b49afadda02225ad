#pragma once

#include <cstddef>

namespace offstage {

/// Whether all of this memory is as the system has handed it out: private, of no file, and no page of it
/// ever read or written, so that it holds zeros and takes no room yet. Whether it may be written is not
/// asked. False in doubt: where /proc is missing, and of less than a page. Keeps errno. Takes about 10 µs.
bool isFreshMemory(const void* begin, std::size_t bytes) noexcept;

} // namespace offstage
