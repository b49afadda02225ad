#pragma once

#include "src/sim/processor.h"

#include <cstddef>
#include <cstdint>

namespace offstage {

/// Drops every fourth byte: `pixels` of RGBA at `rgba` become as many of RGB at `rgb`, which lie elsewhere.
/// Reads and writes nothing beyond them.
void packRgb(const std::uint8_t* rgba, std::uint8_t* rgb, std::size_t pixels, bool wide = processorIsWide());

} // namespace offstage
