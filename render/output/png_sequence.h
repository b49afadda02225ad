#pragma once

#include "render/output/chunked_output.h"
#include "render/output/frame_pattern.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace offstage {

/// Frames as numbered PNG files. Makes the folder and its parents. Each file appears atomically as soon as it
/// is whole, so what an interrupted run leaves are whole frames; they stay, and so do files of earlier runs
/// that this one does not write anew (notice() tells of them). A chunk's file only says which frames are done
/// and how large they are.
class PngSequenceOutput : public ChunkedOutput {
public:
  /// Throws Error(BadInput) when the pattern is bad, the folder cannot be made or written to, or a quality
  /// other than lossless is asked for.
  PngSequenceOutput(const std::filesystem::path& pattern, const SinkFormat& format);

  [[nodiscard]] std::string description() const override;
  [[nodiscard]] std::string notice() const override;
  [[nodiscard]] std::unique_ptr<ChunkWriter> begin(const std::filesystem::path& file,
                                                   std::int64_t firstFrame) const override;
  [[nodiscard]] bool isWhole(const std::filesystem::path& file) const override;
  std::int64_t join(std::span<const std::filesystem::path> chunks, std::int64_t frames) override;

private:
  FramePattern pattern_;
  SinkFormat format_;
  std::int64_t frames_ = 0; ///< of the whole, after join()
};

} // namespace offstage
