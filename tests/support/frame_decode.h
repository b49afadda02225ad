#pragma once

#include "render/raster/frame.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace offstage::test {

/// A decoded frame as RGBA, and when it is shown.
struct ShownFrame {
  Frame frame;
  double start = 0.0;    ///< s
  double duration = 0.0; ///< s, as the packet says; 0 where the container does not
};

/// Decodes a file with one stream of any codec that an output has, alpha included. RGB formats keep their
/// values; YUV is converted by ITU-R BT.709 in limited range, chroma of 4:2:0 taken from the nearest sample.
/// Throws std::runtime_error when anything is wrong with the file.
std::vector<ShownFrame> decodeFrames(const std::filesystem::path& file);

/// What differs between two frames of one size, in levels.
struct FrameDifference {
  int worst = 0;     ///< of red, green, blue
  double mean = 0.0; ///< of red, green, blue
  double meanAlpha = 0.0;
};
FrameDifference compareFrames(const Frame& a, const Frame& b);

} // namespace offstage::test
