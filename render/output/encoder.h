#pragma once

#include "render/output/libav.h"
#include "render/output/yuv.h"
#include "render/raster/frame.h"

#include <cstdint>
#include <functional>
#include <map>

namespace offstage {

/// What all chunks of a video have in common. Equal settings give streams that can be joined.
struct EncoderSettings {
  int width = 0;              ///< px of the frames; odd sizes are padded to even
  int height = 0;             ///< px
  AVRational timeBase{0, 1};  ///< s: the unit of timestamps
  AVRational frameRate{0, 1}; ///< 1/s: of a constant rate, or what the rate control is to reckon with
  int keyInterval = 250;      ///< frames from one key frame to the next, at most
};

/// One H.264 encoder from its first frame to its last: High profile, yuv420p, BT.709, limited range, closed
/// GOP, one thread, constant quality. The packets depend only on the settings and the frames: not on the
/// machine's cores, its instruction sets, the time or chance.
class VideoEncoder {
public:
  /// Takes each packet as it comes out, in decoding order: pts and duration in the settings' time base, dts
  /// not set (Muxer derives it for the whole file). Timestamps are the frames' own, so the packets of chunks
  /// fit together.
  using PacketTaker = std::function<void(AVPacket&)>;

  /// Throws Error(Environment) when libavcodec has no libx264; Error(BadInput) when x264 refuses the size.
  explicit VideoEncoder(const EncoderSettings& settings);

  /// `start` must be greater than that of the frame before, `duration` > 0; both in the time base.
  void encode(const Frame& frame, std::int64_t start, std::int64_t duration, const PacketTaker& take);
  /// Hands out what the encoder still holds; nothing may be encoded afterwards.
  void drain(const PacketTaker& take);

  /// What the muxer needs: parameter sets, size, colour and the depth of reordering (video_delay).
  [[nodiscard]] const AVCodecParameters& parameters() const { return *parameters_; }

private:
  void send(const AVFrame* picture, const PacketTaker& take);

  EncoderSettings settings_;
  libav::CodecContext context_;
  libav::CodecParameters parameters_;
  libav::VideoFrame picture_;
  libav::Packet packet_;
  Yuv420Converter converter_;
  /// By start: x264 reorders frames and does not carry their durations.
  std::map<std::int64_t, std::int64_t> durations_;
};

} // namespace offstage
