#pragma once

#include "render/job/render_options.h"
#include "render/job/source.h"

#include <cstdint>
#include <optional>

namespace offstage {

// A run without drawing, of a source that is at frame 0. With a strict WarningLog it throws what there is to
// warn of before anything is made: what an output's readers see already, and what it replaces, stays whole.

/// Up to this frame.
void rehearse(Source& source, std::int64_t frame);

/// As far as `options` has it drawn, options.poster included, which shows the video at `posterAt` (s;
/// nothing: in the middle of what is rendered).
void rehearse(Source& source, const RenderOptions& options, std::optional<double> posterAt);

} // namespace offstage
