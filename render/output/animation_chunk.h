#pragma once

#include "render/output/chunk_file.h"
#include "render/output/chunked_output.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace offstage {

/// A frame of an animated picture as what changed since the frame kept before it in the same chunk; all of
/// the first frame of a chunk.
struct AnimationPatch {
  FrameTiming timing;
  PixelRect rect; ///< px, never empty
  std::vector<std::uint8_t>
      zlib; ///< compressed rows: a zero (PNG's filter None), then RGBA of the rect's pixels
};

/// What a frame that did not change holds instead of nothing.
inline constexpr PixelRect kOnePixel{0, 0, 1, 1};

/// Makes the chunk of an animated picture (.apng, .gif). Frames that `keeps` is false for are left out. With
/// an opaque format, pixels that did not change are transparent black, to be laid over the frame before;
/// otherwise the patch replaces the pixels of its rect.
std::unique_ptr<ChunkWriter> makeAnimationChunk(const std::filesystem::path& file, const SinkFormat& format,
                                                std::int64_t firstFrame,
                                                std::function<bool(const FrameTiming&)> keeps);

/// Reads such chunks one after another.
class AnimationReader {
public:
  explicit AnimationReader(std::span<const std::filesystem::path> chunks) : chunks_(chunks) {}
  bool next(AnimationPatch& patch); ///< false after the last patch of the last chunk

private:
  std::span<const std::filesystem::path> chunks_;
  std::size_t nextChunk_ = 0;
  std::unique_ptr<ChunkFileReader> reader_;
  std::vector<std::uint8_t> record_;
};

/// Uncompresses patches into rows of a filter byte and RGBA pixels.
class PatchInflater {
public:
  PatchInflater();
  ~PatchInflater();
  PatchInflater(const PatchInflater&) = delete;
  PatchInflater& operator=(const PatchInflater&) = delete;

  /// Valid until the next call. Throws Error(Transient) when the patch is damaged.
  std::span<const std::uint8_t> rows(const AnimationPatch& patch);

private:
  struct Decompressor;
  std::unique_ptr<Decompressor> decompressor_;
  std::vector<std::uint8_t> rows_;
};

} // namespace offstage
