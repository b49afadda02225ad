#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace offstage {

class Sound;

/// A text that stands beside the picture for a while.
struct Cue {
  std::int64_t start = 0; ///< ns of the video
  std::int64_t end = 0;   ///< ns, > start
  std::string text;       ///< UTF-8, lines separated by \n; no other control characters
  friend bool operator==(const Cue&, const Cue&) = default;
};

/// A part of a video that players list.
struct Chapter {
  std::int64_t start = 0; ///< ns of the video
  std::int64_t end = 0;   ///< ns, > start
  std::string title;
  friend bool operator==(const Chapter&, const Chapter&) = default;
};

/// What a video holds beside its pictures.
struct VideoTracks {
  std::vector<Cue> captions;     ///< by start; they may overlap
  std::vector<Chapter> chapters; ///< from 0 on without gaps, or none
  std::shared_ptr<Sound> sound;  ///< null: none
  std::int64_t end = 0;          ///< ns: of the video; captions are cut there, and the sound lasts so long
};

} // namespace offstage
