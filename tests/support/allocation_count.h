#pragma once

#include <cstddef>
#include <optional>

namespace offstage::test {

/// How often this thread has called operator new since it last asked; nothing under a sanitizer, which has
/// its own.
std::optional<std::size_t> allocationsSinceLastCall();

/// Bytes that operator new has given this thread and that it has not given back; below 0 when it gave back
/// another thread's. Nothing under a sanitizer.
std::optional<std::ptrdiff_t> bytesHeld();

} // namespace offstage::test
