#pragma once

#include "render/output/chunked_output.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace offstage {

/// Frames as an animated PNG (PNG specification, third edition, section 11.3.4: acTL, fcTL, fdAT): RGBA,
/// every pixel as drawn, each frame only what changed since the one before it; repeats for ever. The delay of
/// a frame is a fraction of 16-bit numbers: a constant rate is exact where it is such a fraction; otherwise
/// times are rounded to milliseconds, and frames that begin and end in the same millisecond are left out.
class ApngOutput : public ChunkedOutput {
public:
  /// Throws Error(BadInput) for a quality other than lossless and a file that cannot be written.
  ApngOutput(const std::filesystem::path& path, const SinkFormat& format);

  [[nodiscard]] std::string description() const override;
  [[nodiscard]] bool holds(const FrameTiming& timing) const override;
  [[nodiscard]] std::unique_ptr<ChunkWriter> begin(const std::filesystem::path& file,
                                                   std::int64_t firstFrame) const override;
  [[nodiscard]] bool isWhole(const std::filesystem::path& file) const override;
  std::int64_t join(std::span<const std::filesystem::path> chunks, std::int64_t frames) override;

private:
  std::filesystem::path path_;
  SinkFormat format_;
  int ticksPerSecond_ = 1000; ///< a delay is ticks × tick_ / ticksPerSecond_
  int tick_ = 1;
  bool byIndex_ = false; ///< a tick is a frame of the constant rate
};

} // namespace offstage
