#pragma once

#include "render/job/render_options.h"
#include "render/job/source.h"
#include "render/output/atomic_file.h"

#include <filesystem>
#include <optional>

namespace offstage {

/// Pixels a metre of a picture that is printed at its scene's size: 72 to the inch for each output pixel of a
/// scene pixel.
int printResolution(double scale);

/// The moment (s of the video) that a poster shows: `at`, or without one, or where the video has been cut
/// before it, the middle of what `options` have rendered. Throws Error(BadInput) when that is nothing.
double posterMoment(const Source& source, const RenderOptions& options, std::optional<double> at);

/// The picture that stands for a video: a .png, .jpg or .jpeg that appears whole or not at all.
class Poster {
public:
  /// Throws Error(BadInput) for another ending and a file that cannot be written.
  explicit Poster(std::filesystem::path file);

  /// Throws Error(BadInput) for a JPEG of what is not opaque: before a video is made that it belongs to.
  void requireFit(const Source& source) const;

  /// Draws what the video shows at posterMoment() and puts the file under its name. Tells when that is not
  /// `at`, or lies outside of what is rendered. `source` must be at frame 0. `scale`: output pixels per scene
  /// pixel, for the picture's resolution. Throws Error(BadInput) when a JPEG's background is not opaque.
  void write(Source& source, const RenderOptions& options, std::optional<double> at, double scale);

private:
  std::filesystem::path path_;
  bool isPng_;
  AtomicFile file_;
};

} // namespace offstage
