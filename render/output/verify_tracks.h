#pragma once

#include "render/output/muxer.h"
#include "render/output/tracks.h"

#include <filesystem>

namespace offstage {

/// Reopens a finished video and compares what stands beside its pictures with what it must be: chapters with
/// their titles and times, every caption's text and times (to a millisecond), and the sound's codec, rate and
/// length (to one of its packets). Throws Error(Transient) that lists every difference; `name` is what
/// messages call the file.
void verifyTracks(const std::filesystem::path& file, Container container, const VideoTracks& expected,
                  const std::filesystem::path& name);

} // namespace offstage
