#pragma once

#include "render/output/atomic_file.h"
#include "render/output/sink.h"

#include <cstdint>
#include <filesystem>

namespace offstage {

/// Frames as bytes one after another: RGBA8, rows top-down, no header, no padding. Their size is what the
/// reader has to know; so is their timing.
class RawFileSink : public Sink {
public:
  RawFileSink(const std::filesystem::path& path, const SinkFormat& format);

  void write(const Frame& frame, const FrameTiming& timing) override;
  void finish() override; ///< throws Error(BadInput) when there was no frame
  [[nodiscard]] std::int64_t bytesWritten() const override { return bytes_; }

private:
  AtomicFile file_;
  SinkFormat format_;
  std::int64_t bytes_ = 0;
};

/// The same into an open descriptor, which stays open: standard output. There nothing can be atomic: the
/// reader gets each frame when it is drawn.
class RawPipeSink : public Sink {
public:
  /// Throws Error(BadInput) when the descriptor is closed or a terminal.
  RawPipeSink(int descriptor, const SinkFormat& format);

  /// Throws Error(Transient) when the reader has gone away; SIGPIPE must be ignored, or it ends the process.
  void write(const Frame& frame, const FrameTiming& timing) override;
  void finish() override; ///< throws Error(BadInput) when there was no frame
  [[nodiscard]] std::int64_t bytesWritten() const override { return bytes_; }

private:
  int descriptor_;
  SinkFormat format_;
  std::int64_t bytes_ = 0;
};

} // namespace offstage
