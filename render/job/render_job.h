#pragma once

#include "render/job/render_options.h"
#include "render/job/source.h"
#include "src/scene/scene.h"

#include <cstdint>

namespace offstage {

/// What came out of a render.
struct RenderResult {
  std::int64_t frames = 0;
  double seconds = 0.0; ///< s: length of the video
  double elapsed = 0.0; ///< s: wall-clock time that it took
  std::int64_t bytes = 0;
};

/// Steps `source` through the frames that the options ask for, draws each and makes options.out of them.
/// `source` must be at frame 0. Raw outputs are written front to back in this process; all others are made in
/// chunks, by options.jobs worker processes (workers.h), and finished chunks wait in OUT.parts until the
/// whole is joined, checked and put under its name. Throws Error; then nothing is left under the output's
/// name but pictures of a sequence, and the chunks in OUT.parts stay, so that the same call goes on from
/// there. With options.segment the segment's chunks are left there for joinSegments (chunked_render.h).
///
/// Workers are forked: user code that runs in frames (an Exercise) runs in several processes, so what it
/// prints may come twice. options.jobs = 0 forks none.
RenderResult render(Source& source, const RenderOptions& options);

/// Throws Error(BadInput) unless the options name something to make (an output, a hash file or a poster), and
/// each in a place of its own.
void requireOutput(const RenderOptions& options);

/// Throws Error(BadInput) when an output would replace the scene, a file that it is made with
/// (output_places.h), or its captions' file.
void requireApart(const RenderOptions& options, const Scene& scene);

/// Prints what a command ends with, "out.mp4: 1200 frames, 20.000 s, in 3.21 s (6.2x real time), 812 KiB", to
/// standard output, or to stderr when the frames themselves went to standard output.
void printSummary(const RenderResult& result, const RenderOptions& options);

} // namespace offstage
