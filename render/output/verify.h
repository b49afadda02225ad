#pragma once

#include "render/output/libav.h"
#include "render/output/video_codec.h"

#include <cstdint>
#include <filesystem>

namespace offstage {

/// What a finished video must be.
struct ExpectedVideo {
  VideoCodec codec = VideoCodec::H264;
  int width = 0;  ///< px
  int height = 0; ///< px
  std::int64_t frames = 0;
  std::uint64_t packets = 0;  ///< PacketHash of all that were encoded
  AVRational timeBase{0, 1};  ///< s: the unit of the two times
  std::int64_t lastStart = 0; ///< when the last frame begins; the first begins at 0
  std::int64_t end = 0;       ///< when the last frame ends
  bool hasSound = false;      ///< the file may last a packet of sound longer
};

/// Reopens a video file, reads all of it, decodes its first frame and its last, and compares what it finds
/// with what it must be: every packet; codec, profile, pixel format and colour (H.264: High, yuv420p, BT.709
/// in limited range, chroma sited left); the number of frames, their size, the time of the first and the
/// last, and the duration (to one tick of the file, or a millisecond where that is finer). Throws
/// Error(Transient) that lists every difference; `name` is what messages call the file.
void verifyVideo(const std::filesystem::path& file, const ExpectedVideo& expected,
                 const std::filesystem::path& name);

} // namespace offstage
