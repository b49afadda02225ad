#pragma once

#include "render/output/quality.h"
#include "render/raster/frame.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace offstage {

/// What every output is told before the first frame.
struct SinkFormat {
  int width = 0;      ///< px
  int height = 0;     ///< px
  bool alpha = false; ///< the background is not opaque
  double fps =
      0.0; ///< > 0: frame k is shown from k/fps on; 0: variable, from the frames' times. A rate is kept
           ///< as the nearest fraction with terms up to 1001000 (29.97 is 2997/100, not 30000/1001)
  std::string title{};              ///< metadata; may be empty
  std::optional<Quality> quality{}; ///< nothing: the format's default
};

/// When a frame is shown.
struct FrameTiming {
  std::int64_t index = 0; ///< of the output, from 0
  std::int64_t start = 0; ///< ns
  std::int64_t end = 0;   ///< ns: start of the next frame, or the end
};

/// Takes frames in order and writes them front to back. Nothing appears under a file's name before finish(),
/// and an older file of that name stays until then; a sink that is destroyed without finish() leaves nothing
/// behind. All functions throw Error: BadInput for what can never work, Transient when the disk is full.
/// After an error the sink can only be destroyed.
class Sink {
public:
  virtual ~Sink() = default;
  Sink() = default;
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;

  virtual void write(const Frame& frame, const FrameTiming& timing) = 0;
  virtual void finish() = 0; ///< throws Error(BadInput) when there was no frame
  [[nodiscard]] virtual std::int64_t bytesWritten() const = 0;

  /// `watch` is called when a signal may have interrupted write() while it waits for a reader; what it throws
  /// ends the waiting. Without one, write() waits on.
  void setSignalWatch(std::function<void()> watch) { signalWatch_ = std::move(watch); }

protected:
  void tellSignal() const {
    if (signalWatch_) signalWatch_();
  }

private:
  std::function<void()> signalWatch_;
};

/// The sink of a raw output: "-" (RGBA to standard output) or a name that ends in .raw. Throws
/// Error(BadInput) for a size that is none and for a name that is a folder or cannot be written to. Other
/// outputs are made in chunks: chunked_output.h.
std::unique_ptr<Sink> makeSink(const std::filesystem::path& out, const SinkFormat& format);

} // namespace offstage
