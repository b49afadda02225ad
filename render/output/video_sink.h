#pragma once

#include "render/output/atomic_file.h"
#include "render/output/encoder.h"
#include "render/output/muxer.h"
#include "render/output/sink.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace offstage {

/// Frames of a chunk: every kChunkFrames-th frame begins a new one. What a change costs: the bytes of every
/// video.
inline constexpr int kChunkFrames = 240;

/// Frames as H.264 video in .mp4, .mov or .mkv. The video is a row of chunks, each from a fresh encoder;
/// chunk c holds the frames with index / kChunkFrames = c.
///
/// With a constant rate frame k is shown from k/fps to (k + 1)/fps, in a time base of 1/fps. Otherwise times
/// are the frames' own, to a microsecond (.mkv: a millisecond), from the first frame's start; frames that
/// begin and end at the same tick would never be seen and are left out.
class VideoSink : public Sink {
public:
  /// Throws Error(BadInput) for a transparent background, a size or a rate that the format cannot hold, and
  /// a file that cannot be written; Error(Environment) without an encoder.
  VideoSink(const std::filesystem::path& path, Container container, const SinkFormat& format);

  /// Throws Error(BadInput) unless frames are numbered 0, 1, 2 … and, of a variable rate, each begins when
  /// the one before it ends.
  void write(const Frame& frame, const FrameTiming& timing) override;
  /// Ends the file, checks it (verify.h), and only then gives it its name. Throws Error(BadInput) when there
  /// was no frame.
  void finish() override;
  [[nodiscard]] std::string notice() const override;
  [[nodiscard]] std::int64_t bytesWritten() const override;

private:
  struct Span {
    std::int64_t start = 0; ///< ticks
    std::int64_t end = 0;   ///< ticks
  };
  [[nodiscard]] Span spanOf(const FrameTiming& timing) const;
  void requireInOrder(const FrameTiming& timing) const;
  void drainEncoder();

  SinkFormat format_;
  EncoderSettings settings_;
  AtomicFile file_;
  std::unique_ptr<VideoEncoder> encoder_;
  std::unique_ptr<Muxer> muxer_;
  std::int64_t chunk_ = 0;  ///< that encoder_ is for
  std::int64_t frames_ = 0; ///< encoded
  std::int64_t origin_ = 0; ///< ns: start of the first frame; of a variable rate
  std::int64_t nextIndex_ = 0;
  std::int64_t nextStart_ = 0; ///< ns
  Span last_;                  ///< of the last frame that was encoded
};

} // namespace offstage
