#pragma once

#include "render/job/source.h"
#include "render/output/atomic_file.h"

#include <filesystem>
#include <optional>

namespace offstage {

/// Pixels a metre of a picture that is printed at its scene's size: 72 to the inch for each output pixel of a
/// scene pixel.
int printResolution(double scale);

/// The picture that stands for a video: a .png, .jpg or .jpeg that appears whole or not at all.
class Poster {
public:
  /// Throws Error(BadInput) for another ending and a file that cannot be written.
  explicit Poster(std::filesystem::path file);

  /// Throws Error(BadInput) for a JPEG of what is not opaque: before a video is made that it belongs to.
  void requireFit(const Source& source) const;

  /// Draws what the video shows at `at` (s of the video; nothing: at half of it) and puts the file under its
  /// name. `source` must be at frame 0. `scale`: output pixels per scene pixel, for the picture's resolution.
  /// Throws Error(BadInput) when `at` lies outside the video, or a JPEG's background is not opaque.
  void write(Source& source, std::optional<double> at, double scale);

private:
  std::filesystem::path path_;
  bool isPng_;
  AtomicFile file_;
};

} // namespace offstage
