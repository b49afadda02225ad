#pragma once

#include "render/output/libav.h"
#include "render/output/muxer.h"
#include "render/output/sound_encoder.h"
#include "render/output/tracks.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace offstage {

/// The codec of sound in a container: AAC in .mp4 and .mov; Opus in .webm and .mkv, which cannot say how much
/// of AAC's first packet is only its run-up.
SoundCodec soundCodecOf(Container container);

/// The streams of a file that are no video: sound, and captions as mov_text (.mp4 and .mov, which hold a text
/// at every moment, an empty one between captions) or WebVTT (.mkv and .webm).
class SideStreams {
public:
  /// Encodes the sound. `width` and `height` (px): of the video, which captions stand at the bottom of.
  SideStreams(Container container, const VideoTracks& tracks, int width, int height);

  /// Adds the streams and the chapters to a file whose header is not yet written and that has the video as
  /// its first.
  void addTo(AVFormatContext& format);
  /// Writes the packets that begin before `time` (ns of the video) and are not yet written; libav's result.
  int writeUntil(AVFormatContext& format, std::int64_t time);
  int writeRest(AVFormatContext& format);

private:
  struct Stream {
    libav::CodecParameters parameters;
    AVRational timeBase{0, 1};
    std::vector<libav::Packet> packets; ///< by pts
    std::size_t next = 0;               ///< the first that is not yet written
    int index = -1;                     ///< in the file
  };
  void addCaptions(bool movText, const VideoTracks& tracks, int width, int height);
  static std::int64_t startOf(const Stream& stream); ///< ns: of the next packet
  static int writeNext(AVFormatContext& format, Stream& stream);

  std::vector<Stream> streams_;
  std::vector<Chapter> chapters_;
};

} // namespace offstage
