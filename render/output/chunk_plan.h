#pragma once

#include <cstdint>

namespace offstage {

/// The longest chunk, in frames; also the interval of an encoder's key frames.
inline constexpr int kMostChunkFrames = 240;

/// Which frames belong to which chunk. It depends only on the number of frames, so every machine and any
/// number of workers cut a video in the same places. Lengths differ by at most one frame, and chunks come in
/// numbers that two workers, and in longer videos four, share evenly: one chunk below 48 frames, two below
/// 480, then a multiple of four. What a change costs: the bytes of every video.
class ChunkPlan {
public:
  explicit ChunkPlan(std::int64_t frames); ///< frames ≥ 0

  [[nodiscard]] std::int64_t frames() const { return frames_; }
  [[nodiscard]] std::int64_t chunks() const { return chunks_; }
  /// The first frame of a chunk, 0 ≤ chunk ≤ chunks(); begin(chunks()) is frames().
  [[nodiscard]] std::int64_t begin(std::int64_t chunk) const;

private:
  std::int64_t frames_;
  std::int64_t chunks_;
};

} // namespace offstage
