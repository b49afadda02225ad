#pragma once

#include "render/output/frame_pattern.h"
#include "render/output/png.h"
#include "render/output/sink.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace offstage {

/// Frames as numbered PNG files. Makes the folder and its parents. Each file appears atomically as soon as it
/// is whole, so what an interrupted run leaves are whole frames; they stay, and so do files of earlier runs
/// that this one does not write anew (notice() tells of them).
class PngSequenceSink : public Sink {
public:
  /// Throws Error(BadInput) when the pattern is bad or the folder cannot be made or written to.
  PngSequenceSink(const std::filesystem::path& pattern, const SinkFormat& format);

  void write(const Frame& frame, const FrameTiming& timing) override;
  void finish() override; ///< throws Error(BadInput) when there was no frame
  [[nodiscard]] std::string notice() const override;
  [[nodiscard]] std::int64_t bytesWritten() const override { return bytes_; }

private:
  FramePattern pattern_;
  SinkFormat format_;
  PngEncoder encoder_;
  std::int64_t bytes_ = 0;
  std::int64_t frames_ = 0;
  std::int64_t highestNumber_ = -1;
};

} // namespace offstage
