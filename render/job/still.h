#pragma once

#include "render/job/scene_source.h"
#include "render/raster/frame.h"

#include <optional>

namespace offstage {

/// One picture of a scene.
struct Still {
  Frame frame;
  bool alpha = false; ///< the background is not opaque
};

constexpr int kMaxStrobe = 1000;

/// What a source's video shows at `at` seconds of the video: the frame that begins then or before. Throws
/// Error(BadInput) when `at` lies outside the video. `fps` resamples a recorded clock, as it does for a
/// render.
Shot shotAt(const Source& source, double at, std::optional<double> fps = {});

/// How long (s) a source's whole video is.
double videoSeconds(const Source& source);

/// Draws the frame on show at `at` seconds of the video and leaves `source` there. With `strobe` = N > 1 the
/// picture holds N moments of the bodies, equally spaced from 0 to `at`, later ones on top; a body that has
/// not moved since the moment before is drawn once. Throws as shotAt(). `source` must be at frame 0.
Still drawStill(SceneSource& source, double at, int strobe = 1, std::optional<double> fps = {});

/// The frame on show at `at` seconds of any source, and leaves it there. Throws as shotAt().
Frame drawFrame(Source& source, double at);

} // namespace offstage
