#pragma once

#include "render/output/sink.h"
#include "render/output/tracks.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>

namespace offstage {

/// Makes one chunk of an output, from its first frame to its last. Destroyed without finish() it leaves
/// nothing behind. After an error it can only be destroyed.
class ChunkWriter {
public:
  virtual ~ChunkWriter() = default;
  ChunkWriter() = default;
  ChunkWriter(const ChunkWriter&) = delete;
  ChunkWriter& operator=(const ChunkWriter&) = delete;

  /// Throws Error(BadInput) unless frames are numbered without a gap from the chunk's first on and each
  /// begins when the one before it ends.
  virtual void write(const Frame& frame, const FrameTiming& timing) = 0;
  /// In the place of write() for a frame that the output does not hold: it need not be drawn. Throws as it.
  virtual void skip(const FrameTiming& timing) = 0;
  virtual void finish() = 0; ///< the chunk's file then stands under its name, on the disk
  [[nodiscard]] virtual std::int64_t bytesWritten() const = 0;
};

/// An output that is made as a row of chunks, in any order and in any processes, which are then joined. The
/// bytes of a chunk depend only on the output's description(), the chunk's frames and their timings.
/// All functions throw Error: BadInput for what can never work, Transient when the disk is full or a chunk is
/// damaged, Environment when an encoder is missing.
class ChunkedOutput {
public:
  virtual ~ChunkedOutput() = default;
  ChunkedOutput() = default;
  ChunkedOutput(const ChunkedOutput&) = delete;
  ChunkedOutput& operator=(const ChunkedOutput&) = delete;

  /// One line with all that the chunks depend on beside their frames: codec, size, rate, …
  [[nodiscard]] virtual std::string description() const = 0;
  /// Things that the user should know, such as an odd size padded to even; one sentence a line, empty when
  /// none. Whole after join().
  [[nodiscard]] virtual std::string notice() const { return {}; }
  /// Whether the output has this frame: one that begins and ends in the same of its units of time is left
  /// out.
  [[nodiscard]] virtual bool holds(const FrameTiming& /*timing*/) const { return true; }
  /// Starts the chunk whose first frame is `firstFrame`. May be called in several processes at once.
  [[nodiscard]] virtual std::unique_ptr<ChunkWriter> begin(const std::filesystem::path& file,
                                                           std::int64_t firstFrame) const = 0;
  /// Whether a whole chunk stands at `file`, and all that belongs to it.
  [[nodiscard]] virtual bool isWhole(const std::filesystem::path& file) const = 0;
  /// Makes the output of its chunks, in order, checks it, and only then gives it its name. Nothing is encoded
  /// again. `frames` is how many frames were handed in. Returns the output's bytes.
  virtual std::int64_t join(std::span<const std::filesystem::path> chunks, std::int64_t frames) = 0;

  /// Called now and then by join(), with how many frames it has put into the output; what it throws ends
  /// join().
  void setJoinWatch(std::function<void(std::int64_t joined)> watch) { joinWatch_ = std::move(watch); }
  /// What join() puts beside the pictures, as far as the format can hold it.
  void setTracks(VideoTracks tracks) { tracks_ = std::move(tracks); }

protected:
  [[nodiscard]] const VideoTracks& tracks() const { return tracks_; }
  void tellJoined(std::int64_t frames) const {
    if (joinWatch_) joinWatch_(frames);
  }

private:
  VideoTracks tracks_;
  std::function<void(std::int64_t)> joinWatch_;
};

/// The output that `out`'s ending asks for (outputKind): H.264 in .mp4 .mkv .mov, VP9 in .webm, ProRes 4444
/// in .mov and VP9 in .webm for a transparent background, lossless .mkv, .gif, .apng, a PNG sequence (its
/// folder is made). Throws Error(BadInput) for what the format cannot hold and for a name that is a folder or
/// cannot be written to; Error(Environment) without the encoder.
std::unique_ptr<ChunkedOutput> makeChunkedOutput(const std::filesystem::path& out, const SinkFormat& format);

} // namespace offstage
