#pragma once

#include "render/output/libav.h"
#include "render/output/pixel_converter.h"
#include "render/output/video_codec.h"
#include "render/raster/frame.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>

namespace offstage {

/// What all chunks of a video have in common. Equal settings give streams that can be joined.
struct EncoderSettings {
  VideoCodec codec = VideoCodec::H264;
  Quality quality = Quality::Good;
  bool alpha = false;
  int width = 0;              ///< px of the frames; odd sizes are padded to even where the codec needs it
  int height = 0;             ///< px
  AVRational timeBase{0, 1};  ///< s: the unit of timestamps
  AVRational frameRate{0, 1}; ///< 1/s: of a constant rate, or what the rate control is to reckon with
};

/// Throws Error(Environment) when libavcodec lacks the codec's encoder.
void requireEncoder(VideoCodec codec);

/// One encoder from its first frame to its last: closed GOP, one thread, constant quality. The packets depend
/// only on the settings and the frames: not on the machine's cores, its instruction sets, the time or chance.
class VideoEncoder {
public:
  /// Takes each packet as it comes out, in decoding order: pts and duration in the settings' time base, dts
  /// not set (Muxer derives it for the whole file). Timestamps are the frames' own, so the packets of chunks
  /// fit together.
  using PacketTaker = std::function<void(const AVPacket&)>;

  /// Throws as requireEncoder; Error(BadInput) when the encoder refuses the size.
  explicit VideoEncoder(const EncoderSettings& settings);

  /// `start` must be greater than that of the frame before, `duration` > 0; both in the time base.
  void encode(const Frame& frame, std::int64_t start, std::int64_t duration, const PacketTaker& take);
  /// Hands out what the encoder still holds; nothing may be encoded afterwards.
  void drain(const PacketTaker& take);

  /// What the muxer needs: parameter sets, size, colour and the depth of reordering (video_delay).
  [[nodiscard]] const AVCodecParameters& parameters() const { return *parameters_; }

private:
  void send(const AVFrame* picture, const PacketTaker& take);

  const CodecTraits& traits_;
  libav::CodecContext context_;
  libav::CodecParameters parameters_;
  libav::VideoFrame picture_;
  libav::Packet packet_;
  std::unique_ptr<PixelConverter> converter_;
  /// By start: encoders reorder frames and do not carry their durations.
  std::map<std::int64_t, std::int64_t> durations_;
};

} // namespace offstage
