#pragma once

#include "render/output/libav.h"

#include <cstdint>
#include <functional>
#include <string_view>

namespace offstage {

/// Decodes frames of a video to see whether they decode and when they begin; the pictures themselves are
/// let go, and not smoothed (H.264's loop filter).
class FrameDecoder {
public:
  /// Throws Error: with the text that it is given, and what libav says where it says something.
  using Fail = std::function<void(std::string_view why)>;

  /// `fail` is called where something does not decode. Throws Error(Environment) when libavcodec has no
  /// decoder for the stream.
  FrameDecoder(const AVStream& stream, Fail fail);

  /// Nothing that libav has to say of it is printed from here on.
  void silence() { context_->log_level_offset = kNeverShown; }

  /// Whether a frame came out. A null packet asks for what the decoder still holds, and ends it.
  bool decode(const AVPacket* packet);

  [[nodiscard]] std::int64_t first() const { return first_; } ///< the earliest pts of all, or AV_NOPTS_VALUE
  [[nodiscard]] std::int64_t last() const { return last_; }   ///< the latest one
  [[nodiscard]] const AVCodecContext& context() const { return *context_; } ///< what it found out

private:
  static constexpr int kNeverShown = AV_LOG_MAX_OFFSET;

  int check(int result, std::string_view what) const;

  Fail fail_;
  libav::CodecContext context_;
  libav::VideoFrame frame_;
  std::int64_t first_ = AV_NOPTS_VALUE;
  std::int64_t last_ = AV_NOPTS_VALUE;
};

} // namespace offstage
