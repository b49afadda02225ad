#pragma once

#include "render/output/tracks.h"

#include <filesystem>
#include <string>

namespace offstage {

/// What of the scene's sound, captions and chapters goes neither into the output nor beside it, as a notice:
/// "'x.raw' holds no sound, captions or chapters". Empty where nothing is left out.
std::string leftOutNotice(const std::filesystem::path& out, const VideoTracks& tracks);

} // namespace offstage
