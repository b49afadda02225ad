#pragma once

#include "src/scene/time_map.h"
#include "src/scene/timeline.h"
#include "src/sim/clock.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace offstage {

/// A moment of the simulation: a frame of the clock, or a place between it and the next.
struct Moment {
  std::int64_t frame = 0;
  double fraction = 0.0; ///< 0 ≤ fraction < 1 of the way to the next frame
  friend bool operator==(const Moment&, const Moment&) = default;
};

/// What a frame of a video shows.
struct Shot {
  Moment moment;
  double time = 0.0; ///< s of the video
};

/// A scene's timeline worked out: what is shown when, in seconds of the video.
struct Film {
  struct Chapter {
    std::string title;
    double start = 0.0;
    double end = 0.0;
  };
  struct Card {
    std::string title;
    std::string subtitle; ///< may be empty
    double from = 0.0, to = 0.0;
  };
  struct Freeze {
    std::size_t pause = 0; ///< index into Timeline::pauses
    double from = 0.0, to = 0.0;
  };
  struct Voice {
    SoundFile sound;
    double start = 0.0;
  };

  Clock clock = Clock::fixed(60.0, 0);
  double fps = 60.0; ///< of the video, where `map` is given
  /// Positions in frames of 1/fps of simulated time. Nothing: the video's time is the clock's.
  std::optional<TimeMap> map;
  double seconds = 0.0;           ///< length of the video
  std::vector<Chapter> chapters;  ///< from 0 to the end without gaps, or none
  std::vector<Caption> captions;  ///< those with a time
  std::vector<CameraMove> camera; ///< by time
  std::vector<Card> cards;
  std::vector<Freeze> freezes; ///< pauses that point at bodies
  std::vector<Voice> voices;   ///< by start; they do not overlap

  /// What frame `index` of the video shows; only with `map`.
  [[nodiscard]] Moment moment(std::int64_t index) const;
  /// When the video shows a moment of simulated time (s).
  [[nodiscard]] double videoTime(double simulated) const;
};

/// Works a timeline out. `narrations`: how long (s) the sound of each narration is, in the order of the
/// sections, or of the whole video's one. In the video
/// - a speed's or a pause's moment is the first simulated frame not before it, and every length is rounded to
/// whole frames
///   of the video (at least one), so that frames at normal speed are always simulated ones;
/// - a section's card stands at the section's start, within the section;
/// - a section that is shorter than its narration stands at its end until that is over, and all sections
/// after it start as
///   much later; with one narration for the whole video, the end stands;
/// - times of captions and cameras are the video's, or with a `section`, those since its start.
///
/// Throws SceneError when something lies after the video's end, unless `cut`: then it is left out, because
/// somebody asked for a shorter video; and when a section starts while another's card stands. `title`: of the
/// chapter before the first section, if that does not begin at 0.
Film makeFilm(const Timeline& timeline, const Clock& clock, std::span<const double> narrations,
              const std::string& title);

} // namespace offstage
