#pragma once

#include "render/output/atomic_file.h"
#include "render/output/tracks.h"

#include <filesystem>
#include <optional>

namespace offstage {

/// The captions of a video as a file beside it, which players find by its name: lecture.vtt beside
/// lecture.mp4.
class Sidecar {
public:
  /// `out`: the video or animation. Throws Error(BadInput) when something stands under the sidecar's name
  /// that no render has made, so that a file somebody wrote is never replaced; as AtomicFile when it cannot
  /// be written.
  explicit Sidecar(const std::filesystem::path& out);
  /// Writes it, whole or not at all.
  void write(const VideoTracks& tracks) const;

  /// Removes what an earlier render has left beside a video that has no captions now, which would be shown
  /// with it. Somebody else's file stays. Throws as AtomicFile when it cannot be removed.
  static void removeStale(const std::filesystem::path& out);

  /// Its name. Nothing for outputs that have none: a pipe, raw frames and picture sequences.
  static std::optional<std::filesystem::path> nameFor(const std::filesystem::path& out);

private:
  std::filesystem::path file_;
};

} // namespace offstage
