#pragma once

#include "render/job/render_options.h"
#include "src/scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace offstage {

/// What a bundle's slide GIF is at most: px wide, s long.
inline constexpr int kBundleGifWidth = 640;
inline constexpr double kBundleGifSeconds = 15.0;

/// Makes a folder with all that a lecture's page needs, `NAME` being the scene file's without its ending:
/// NAME.mp4, NAME.webm, NAME.vtt (captions), NAME.chapters.vtt, NAME.jpg (the poster), NAME.gif (for a slide:
/// the video's first kBundleGifSeconds), NAME.csv (the trace; not of a replay) and index.html, which plays
/// it. The two .vtt only where the scene has captions and sections. The folder appears whole or not at all;
/// see StagedFolder for what it may replace. `options`: what is drawn; `out` is the folder. Returns the names
/// of the files, in order. Throws as render().
std::vector<std::string> makeBundle(const Scene& scene, const RenderOptions& options);

} // namespace offstage
