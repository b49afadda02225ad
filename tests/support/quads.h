#pragma once

#include "render/raster/instance.h"

#include <cstdint>

namespace offstage::test {

/// An instance that shades these pixels, and nothing else said.
inline Instance quad(int left, int top, int width, int height) {
  Instance instance;
  instance.quad = {static_cast<std::uint16_t>(left), static_cast<std::uint16_t>(top),
                   static_cast<std::uint16_t>(left + width), static_cast<std::uint16_t>(top + height)};
  return instance;
}

inline bool overlap(const Instance& a, const Instance& b) {
  return a.quad[0] < b.quad[2] && b.quad[0] < a.quad[2] && a.quad[1] < b.quad[3] && b.quad[1] < a.quad[3];
}

} // namespace offstage::test
