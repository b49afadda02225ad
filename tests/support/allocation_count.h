#pragma once

#include <cstddef>
#include <optional>

namespace offstage::test {

/// How often this thread has called operator new since it last asked; nothing under a sanitizer, which has
/// its own.
std::optional<std::size_t> allocationsSinceLastCall();

} // namespace offstage::test
