#pragma once

#include "render/output/sink.h"
#include "render/raster/frame.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace offstage::test {

/// Number of a pixel in rows of `width`.
constexpr std::size_t pixelIndex(int row, int width, int column) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
}

/// A frame of one colour, opaque unless said otherwise.
Frame flatFrame(int width, int height, std::array<std::uint8_t, 4> rgba);

/// Every byte from a fixed sequence, alpha too.
Frame noiseFrame(int width, int height, std::uint32_t seed);

/// Frame `number` of a lecture-like animation: antialiased circles of several colours that move over white.
Frame lectureFrame(int width, int height, int number);

/// Timing of frame `index` at a constant rate.
FrameTiming fixedTiming(std::int64_t index, double fps);

/// An opaque output of this size and constant rate.
SinkFormat formatOf(int width, int height, double fps = 60.0);

/// The Error that `action` throws, as "CODE: MESSAGE"; "no error" if it throws none.
std::string errorOf(const std::function<void()>& action);

} // namespace offstage::test
