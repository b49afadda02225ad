#pragma once

#include "render/job/render_job.h"

namespace offstage {

/// Renders an output that is made in chunks (isStream(…) = false): see render().
RenderResult renderChunks(Source& source, const RenderOptions& options);

/// Joins the chunks that segments have left in OUT.parts, and removes them. Options that are given must be
/// those that the segments were rendered with; the others are taken from their manifest. Throws
/// Error(BadInput) when parts are missing or were made from something else than `source`.
RenderResult joinSegments(Source& source, const RenderOptions& options);

/// The options that the segments in OUT.parts were rendered with, those given in `options` put over them.
/// Throws Error(BadInput) when there are no parts.
RenderOptions optionsOfSegments(const RenderOptions& options);

} // namespace offstage
