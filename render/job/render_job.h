#pragma once

#include "render/job/render_options.h"
#include "render/job/source.h"

#include <cstdint>

namespace offstage {

/// What came out of a render.
struct RenderResult {
  std::int64_t frames = 0;
  double seconds = 0.0; ///< s: length of the video
  double elapsed = 0.0; ///< s: wall-clock time that it took
  std::int64_t bytes = 0;
};

/// Steps `source` through the frames that the options ask for, draws each and hands it to the sink of
/// options.out. `source` must be at frame 0. Throws Error; then nothing is left under the output's name.
RenderResult render(Source& source, const RenderOptions& options);

/// Throws Error(BadInput) unless the options name something to make: an output or a hash file.
void requireOutput(const RenderOptions& options);

/// Prints what a command ends with, "out.mp4: 1200 frames, 20.000 s, in 3.21 s (6.2x real time), 812 KiB", to
/// standard output, or to stderr when the frames themselves went to standard output.
void printSummary(const RenderResult& result, const RenderOptions& options);

} // namespace offstage
