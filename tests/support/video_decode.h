#pragma once

#include "render/raster/frame.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace offstage::test {

/// A picture of a video in 8-bit YUV 4:2:0, planes without padding.
struct DecodedPicture {
  std::int64_t start = 0; ///< ns from the beginning, as a player shows it (edit lists applied)
  bool keyFrame = false;
  std::vector<std::uint8_t> y, u, v;
};

/// All that FFmpeg's libraries tell of a file with one video stream. Names are FFmpeg's.
struct DecodedVideo {
  std::string codec;
  std::string profile;
  std::string pixelFormat;
  std::string primaries, transfer, matrix, range, chromaLocation;
  std::string title;
  int width = 0;
  int height = 0;
  double averageRate = 0.0;              ///< 1/s
  std::int64_t duration = 0;             ///< ns, of the file
  std::int64_t streamDuration = 0;       ///< ns, of the stream; -1 where the container has none
  std::vector<std::int64_t> decodeTimes; ///< ns, of the packets in the file's order
  std::vector<DecodedPicture> pictures;  ///< in the order of showing
};

/// Decodes the whole file. Throws std::runtime_error when anything is wrong with it.
DecodedVideo decodeVideo(const std::filesystem::path& file);

/// As RGBA by ITU-R BT.709 in limited range, chroma sited left and interpolated linearly, rounded to 8 bits.
Frame toRgb(const DecodedVideo& video, std::size_t picture);

/// Mean of |a − b| over red, green and blue, in levels; over the part that both sizes have in common.
double meanAbsoluteError(const Frame& a, const Frame& b);

/// Types of an .mp4's or .mov's outermost boxes, in order.
std::vector<std::string> topLevelBoxes(const std::filesystem::path& file);

} // namespace offstage::test
