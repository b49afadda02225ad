#pragma once

#include "render/output/chunked_output.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace offstage {

/// Frames as an animated GIF: one palette for the whole clip (gif_palette.h), each frame only what changed.
/// Times are in 1/100 s, and players take no frame shorter than 2 of them, so there are at most 50 frames a
/// second: of a faster constant rate every second (third, …) frame is kept, which moves evenly; of a variable
/// one, frames that would be shorter are left out.
///
/// The chunks hold the frames without loss. The palette needs all of them, so join() counts their colours
/// first and then writes.
class GifOutput : public ChunkedOutput {
public:
  /// Throws Error(BadInput) for a transparent background, a side above 65535 px, a quality, and a file that
  /// cannot be written.
  GifOutput(const std::filesystem::path& path, const SinkFormat& format);

  [[nodiscard]] std::string description() const override;
  [[nodiscard]] std::string notice() const override;
  [[nodiscard]] bool holds(const FrameTiming& timing) const override;
  [[nodiscard]] std::unique_ptr<ChunkWriter> begin(const std::filesystem::path& file,
                                                   std::int64_t firstFrame) const override;
  [[nodiscard]] bool isWhole(const std::filesystem::path& file) const override;
  std::int64_t join(std::span<const std::filesystem::path> chunks, std::int64_t frames) override;

private:
  std::filesystem::path path_;
  SinkFormat format_;
  std::int64_t every_ = 1; ///< of a constant rate every so many-th frame is kept
};

} // namespace offstage
