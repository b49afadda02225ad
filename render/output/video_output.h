#pragma once

#include "render/output/chunked_output.h"
#include "render/output/encoder.h"
#include "render/output/muxer.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace offstage {

/// Frames as video in .mp4, .mov, .mkv or .webm. Each chunk is encoded by a fresh encoder; a chunk's file
/// holds its packets, and join() only muxes them.
///
/// With a constant rate frame k is shown from k/fps to (k + 1)/fps, in a time base of 1/fps. Otherwise times
/// are the frames' own, to a microsecond (.mkv and .webm: a millisecond); frames that begin and end at the
/// same tick would never be seen and are left out.
class VideoOutput : public ChunkedOutput {
public:
  /// Throws Error(BadInput) for a background, a quality, a size or a rate that the format cannot hold, and a
  /// file that cannot be written; Error(Environment) without an encoder.
  VideoOutput(const std::filesystem::path& path, Container container, const SinkFormat& format);

  [[nodiscard]] std::string description() const override;
  [[nodiscard]] std::string notice() const override;
  [[nodiscard]] bool holds(const FrameTiming& timing) const override;
  [[nodiscard]] std::unique_ptr<ChunkWriter> begin(const std::filesystem::path& file,
                                                   std::int64_t firstFrame) const override;
  [[nodiscard]] bool isWhole(const std::filesystem::path& file) const override;
  std::int64_t join(std::span<const std::filesystem::path> chunks, std::int64_t frames) override;

private:
  std::filesystem::path path_;
  Container container_;
  SinkFormat format_;
  EncoderSettings settings_;
};

} // namespace offstage
