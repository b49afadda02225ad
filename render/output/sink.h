#pragma once

#include "render/raster/frame.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace offstage {

/// What every sink is told before the first frame.
struct SinkFormat {
  int width = 0;      ///< px
  int height = 0;     ///< px
  bool alpha = false; ///< the background is not opaque
  double fps =
      0.0; ///< > 0: frame k is shown from k/fps on; 0: variable, from the frames' times. A rate is kept
           ///< as the nearest fraction with terms up to 1001000 (29.97 is 2997/100, not 30000/1001)
  std::string title; ///< metadata; may be empty
};

/// When a frame is shown.
struct FrameTiming {
  std::int64_t index = 0; ///< of the output, from 0
  std::int64_t start = 0; ///< ns
  std::int64_t end = 0;   ///< ns: start of the next frame, or the end
};

/// Takes frames in order and makes a file of them. Nothing appears under the final name before finish(), and
/// an older file of that name stays until then; a sink that is destroyed without finish() leaves nothing
/// behind. A PNG sequence is many files: each appears whole as soon as its frame is written, and those stay.
/// All functions throw Error: BadInput for what can never work, Transient when the disk is full, Environment
/// when an encoder is missing. After an error the sink can only be destroyed.
class Sink {
public:
  virtual ~Sink() = default;
  Sink() = default;
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;

  virtual void write(const Frame& frame, const FrameTiming& timing) = 0;
  virtual void finish() = 0; ///< throws Error(BadInput) when there was no frame
  /// Things that the user should know, such as an odd size padded to even; one sentence a line, empty when
  /// none. Whole after finish().
  [[nodiscard]] virtual std::string notice() const { return {}; }
  [[nodiscard]] virtual std::int64_t bytesWritten() const = 0;
};

/// The sink that `out`'s ending asks for: .mp4 .mkv .mov (H.264), a printf pattern for PNGs such as
/// frames/%06d.png (numbered from 0; the folder is made), .raw (RGBA), "-" (RGBA to standard output). Upper
/// and lower case of endings are alike. Throws Error(BadInput) for another ending, a pattern without exactly
/// one %d, a name that is a folder or cannot be written to, and for transparency in a format that has none
/// (naming those that do).
std::unique_ptr<Sink> makeSink(const std::filesystem::path& out, const SinkFormat& format);

} // namespace offstage
