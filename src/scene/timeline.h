#pragma once

#include "src/scene/color.h"
#include "src/scene/diagnostic.h"
#include "src/sim/event.h"
#include "src/sim/world_setup.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace offstage {

// What a scene says about its video: when what is shown, and what stands beside the pictures. There are two
// kinds of time. Simulated time is the clock's. Video time is what a player shows: pauses, title cards and
// changes of speed make the two differ (film.h has the map between them). Each field says which one it is in.

/// A sound file that a scene names. It is not opened while the scene is read.
struct SoundFile {
  std::filesystem::path file;
  SourceLocation where; ///< of the name in the scene, for messages
  std::string key;      ///< "'narration' in [[section]]", for messages
};

/// `[[section]]`: a part of the video, and a chapter of its file.
struct Section {
  std::string title;
  double start = 0.0;   ///< s of the video
  double card = 0.0;    ///< s: how long its title card stands at its start; 0: none
  std::string subtitle; ///< a second line of the card; may be empty
  std::optional<SoundFile> narration;
  SourceLocation where;
};

/// `[[caption]]` with a time: a text that stands beside the picture.
struct Caption {
  std::string text;                   ///< UTF-8, lines separated by \n, no other control characters
  double from = 0.0, to = 0.0;        ///< s of the video, from < to; with a section, since its start
  std::optional<std::size_t> section; ///< index into Timeline::sections
  SourceLocation where;
};

/// `[[caption]]` that an event shows.
struct EventCaption {
  std::string text;
  std::vector<EventKind> kinds;      ///< any of these
  std::optional<std::uint32_t> body; ///< the id of a body that must be one of the two; nothing: any
  double length = 2.0;               ///< s of the video
  std::optional<std::int64_t> limit; ///< shown no more often than this
};

/// How a pause points at bodies.
enum class Highlight : std::uint8_t {
  Ring, ///< a ring around each
  Dim,  ///< everything else is dimmed
};

/// `[[pause]]`: the picture stands.
struct Pause {
  double at = 0.0;                   ///< s of simulated time
  double length = 0.0;               ///< s of the video, > 0
  std::vector<std::uint32_t> bodies; ///< ids of those that are pointed at
  Highlight highlight = Highlight::Ring;
  Color color{230, 159, 0, 1.0}; ///< of the rings
};

/// `[[speed]]`: a part of the simulated time that is shown slower or faster.
struct SpeedChange {
  double from = 0.0, to = 0.0; ///< s of simulated time, from < to; those of a scene do not overlap
  double factor = 1.0;         ///< simulated s per s of the video: 0.25 is slow motion, 4 fast forward
};

/// How a camera's move runs from 0 to 1 over its length: u being the share of the time that has passed,
enum class Easing : std::uint8_t {
  Linear, ///< u
  In,     ///< u²
  Out,    ///< 1 − (1 − u)²
  Smooth, ///< 3u² − 2u³
};

/// `[[camera]]`: from `at` on, the camera goes to another view, and stays there.
struct CameraMove {
  double at = 0.0;                    ///< s of the video; with a section, since its start
  std::optional<std::size_t> section; ///< index into Timeline::sections
  double length = 1.0;                ///< s of the video that the move takes; 0: it jumps
  Anchor center;     ///< what is in the middle then: a point in px, or a body, which it follows
  double zoom = 1.0; ///< how much larger things are than without a camera
  Easing easing = Easing::Smooth;
  SourceLocation where;
};

/// All that a scene says about its video's time, in the order of the file but where a comment says otherwise.
struct Timeline {
  double fps = 60.0;                  ///< frames a second of a video whose time is not simply the clock's
  double fadeIn = 0.0, fadeOut = 0.0; ///< s of the video
  Color fadeColor{0, 0, 0, 1.0};
  std::vector<Section> sections; ///< by start, which differ
  std::vector<Caption> captions;
  std::vector<EventCaption> eventCaptions;
  std::vector<Pause> pauses;
  std::vector<SpeedChange> speeds; ///< by time
  std::vector<CameraMove> camera;
  std::optional<SoundFile> narration; ///< of the whole video; then sections have none
  double narrationStart = 0.0;        ///< s of the video
  bool clicks = false;                ///< `[sound]`: contacts can be heard
  double loudestClick = 500.0;        ///< px/s: the closing speed at which a click is loudest
  std::optional<double> poster;       ///< s of the video; nothing: the middle of what is rendered
  SourceLocation posterWhere;
  bool cut = false; ///< the command line has chosen another duration: what lies after the end is left out
};

inline constexpr std::size_t kMaxCaptions = 10000; ///< [[caption]] tables of a scene, and captions of a video
inline constexpr std::size_t kMaxCaptionBytes = 2000;   ///< of one caption's text
inline constexpr std::size_t kMaxSections = 255;        ///< what the chapter list of an .mp4 counts to
inline constexpr std::size_t kMaxSectionBytes = 255;    ///< of a section's title, for the same reason
inline constexpr std::size_t kMaxTimelineTables = 1000; ///< [[pause]], [[speed]] and [[camera]] tables, each
inline constexpr double kMaxPause = 3600.0;             ///< s: of a pause, a card, a camera's move, a fade
inline constexpr double kSlowest = 0.001, kFastest = 1000.0; ///< factors of [[speed]]

} // namespace offstage
