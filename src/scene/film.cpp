#include "src/scene/film.h"

#include "src/scene/quote.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace offstage {
namespace {

/// A time that is k frames up to rounding is meant to be k frames.
constexpr double kRounding = 1e-6;
constexpr double kTimeRounding = 1e-9; ///< s

std::int64_t firstFrameFrom(double seconds, double fps) {
  return static_cast<std::int64_t>(std::ceil(seconds * fps - kRounding));
}

std::int64_t framesOf(double seconds, double fps) {
  return std::max<std::int64_t>(std::llround(seconds * fps), 1);
}

/// A sum of times without what adding has rounded: "0.3", not "0.30000000000000004".
std::string roundedText(double seconds) {
  return numberText(std::round(seconds * 1e9) / 1e9);
}

/// A scene's title as a chapter's: no longer than one may be, in whole characters, and without control
/// characters.
std::string chapterTitle(std::string title) {
  if (title.size() > kMaxSectionBytes) {
    std::size_t length = kMaxSectionBytes;
    while ((static_cast<unsigned char>(title[length]) & 0xc0U) == 0x80U)
      --length; // a character's later bytes
    title.resize(length);
  }
  std::ranges::replace_if(
      title, [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return title;
}

/// Works the map and what depends on it out, step by step.
class FilmMaker {
public:
  FilmMaker(const Timeline& timeline, const Clock& clock, std::span<const double> narrations)
      : timeline_(timeline),
        fps_(timeline.fps),
        simulated_(clock.isFixed() ? clock.steps() : firstFrameFrom(clock.duration(), fps_)),
        narrations_(narrations),
        map_(simulated_, runs()) {
    film_.clock = clock;
    film_.fps = fps_;
  }

  Film make(const std::string& title) {
    addPauses();
    addSections();
    addWholeNarration();
    const bool retimed = !map_.isIdentity();
    film_.seconds = retimed ? static_cast<double>(map_.frames()) / fps_ : film_.clock.duration();
    finishChapters(title);
    addCaptions();
    addCamera();
    addFreezes();
    if (timeline_.poster && *timeline_.poster > film_.seconds + kTimeRounding && !timeline_.cut)
      reject(timeline_.posterWhere, "'at' in [poster]", *timeline_.poster);
    if (!problems_.empty()) throw SceneError(std::move(problems_));
    if (retimed) film_.map = std::move(map_);
    return std::move(film_);
  }

private:
  [[nodiscard]] std::vector<TimeMap::Run> runs() const {
    std::vector<TimeMap::Run> runs;
    std::int64_t done = 0;
    for (const SpeedChange& speed : timeline_.speeds) {
      TimeMap::Run run;
      run.first = std::clamp(firstFrameFrom(speed.from, fps_), done, simulated_);
      run.end = std::clamp(firstFrameFrom(speed.to, fps_), done, simulated_);
      if (run.first == run.end) continue;
      run.frames =
          std::max<std::int64_t>(std::llround(static_cast<double>(run.end - run.first) / speed.factor), 1);
      runs.push_back(run);
      done = run.end;
    }
    return runs;
  }

  void reject(const SourceLocation& where, const std::string& what, double time) {
    problems_.push_back({where, fmt::format("{} is {} s, but the video ends at {} s", what, numberText(time),
                                            numberText(film_.seconds))});
  }

  void rejectStart(const Section& section, std::int64_t shift, const std::string& why) {
    const std::string moved =
        shift > 0 ? fmt::format(" ({} s, moved by narrations)", numberText(section.start)) : std::string();
    problems_.push_back({section.where, fmt::format("'start' in [[section]]{} is {} s, but {}", moved,
                                                    roundedText(startOf(section, shift)), why)});
  }

  /// s of the video
  [[nodiscard]] double startOf(const Section& section, std::int64_t shift) const {
    return shift > 0 ? section.start + seconds(shift) : section.start;
  }

  /// A card that another section cut short would go too early, and leave a picture that stands for nothing.
  void requireNoCardAt(const Section& section, std::int64_t shift) {
    if (startOf(section, shift) < cardEnd_ - kTimeRounding)
      rejectStart(section, shift,
                  fmt::format("the title card of {} stands until {} s", quotedText(cardTitle_),
                              roundedText(cardEnd_)));
  }

  /// From the last one on, so that of two pauses at one moment the first comes first.
  void addPauses() {
    for (std::size_t i = timeline_.pauses.size(); i-- > 0;) {
      const Pause& pause = timeline_.pauses[i];
      const double position = static_cast<double>(firstFrameFrom(pause.at, fps_));
      if (position > static_cast<double>(simulated_)) continue; // cut: the parser refuses it otherwise
      map_.stand(map_.firstAt(position), framesOf(pause.length, fps_), position, static_cast<int>(i));
    }
  }

  void addSections() {
    const std::size_t count = timeline_.sections.size();
    std::int64_t shift = 0; // frames by which narrations have moved what comes
    std::size_t narration = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Section& section = timeline_.sections[i];
      const std::int64_t start = firstFrameFrom(section.start, fps_) + shift;
      // A card may stand at the very end, but not behind it.
      const std::int64_t behind = std::max<std::int64_t>(map_.frames(), 1) + (section.card > 0.0 ? 1 : 0);
      if (start >= behind) {
        film_.seconds = static_cast<double>(map_.frames()) / fps_;
        if (!timeline_.cut)
          rejectStart(section, shift, fmt::format("the video ends at {} s", numberText(film_.seconds)));
        break;
      }
      requireNoCardAt(section, shift);
      const std::int64_t from = std::min(start, map_.frames());
      if (section.card > 0.0) {
        const std::int64_t length = framesOf(section.card, fps_);
        map_.stand(from, length);
        film_.cards.push_back({section.title, section.subtitle, seconds(from), seconds(from + length)});
        cardEnd_ = startOf(section, shift) + section.card;
        cardTitle_ = section.title;
      }
      // Without a map the frames are the clock's own, and a section begins exactly when it says.
      film_.chapters.push_back({section.title, shift == 0 ? section.start : seconds(start), 0.0});
      if (!section.narration) continue;
      const double length = narration < narrations_.size() ? narrations_[narration] : 0.0;
      ++narration;
      film_.voices.push_back({*section.narration, film_.chapters.back().start});
      const std::int64_t end =
          i + 1 < count
              ? std::min(firstFrameFrom(timeline_.sections[i + 1].start, fps_) + shift, map_.frames())
              : map_.frames();
      const std::int64_t missing = firstFrameFrom(length, fps_) - (end - from);
      if (missing <= 0) continue;
      map_.stand(end, missing);
      shift += missing;
    }
  }

  void addWholeNarration() {
    if (!timeline_.narration) return;
    film_.voices.push_back({*timeline_.narration, timeline_.narrationStart});
    if (narrations_.empty()) return;
    const std::int64_t needed = firstFrameFrom(timeline_.narrationStart + narrations_.front(), fps_);
    map_.stand(map_.frames(), needed - map_.frames());
  }

  [[nodiscard]] double seconds(std::int64_t frame) const { return static_cast<double>(frame) / fps_; }

  void finishChapters(const std::string& title) {
    std::vector<Film::Chapter>& chapters = film_.chapters;
    sectionStarts_.reserve(chapters.size());
    for (const Film::Chapter& chapter : chapters) sectionStarts_.push_back(chapter.start);
    if (!chapters.empty() && chapters.front().start > 0.0)
      chapters.insert(chapters.begin(), {chapterTitle(title), 0.0, 0.0});
    for (std::size_t i = 0; i < chapters.size(); ++i)
      chapters[i].end = i + 1 < chapters.size() ? chapters[i + 1].start : film_.seconds;
  }

  /// The start that a time counts from; nothing when its section is cut off.
  [[nodiscard]] std::optional<double> base(const std::optional<std::size_t>& section) const {
    if (!section) return 0.0;
    if (*section >= sectionStarts_.size()) return std::nullopt;
    return sectionStarts_[*section];
  }

  void addCaptions() {
    for (Caption caption : timeline_.captions) {
      const std::optional<double> start = base(caption.section);
      if (!start) continue;
      caption.from += *start;
      caption.to += *start;
      if (caption.from < film_.seconds)
        film_.captions.push_back(std::move(caption));
      else if (!timeline_.cut)
        reject(caption.where, "'from' in [[caption]]", caption.from);
    }
    std::ranges::stable_sort(film_.captions, {}, &Caption::from);
  }

  void addCamera() {
    for (CameraMove move : timeline_.camera) {
      const std::optional<double> start = base(move.section);
      if (!start) continue;
      move.at += *start;
      if (move.at < film_.seconds)
        film_.camera.push_back(std::move(move));
      else if (!timeline_.cut)
        reject(move.where, "'at' in [[camera]]", move.at);
    }
    std::ranges::stable_sort(film_.camera, {}, &CameraMove::at);
  }

  void addFreezes() {
    for (std::size_t i = 0; i < timeline_.pauses.size(); ++i) {
      const auto [first, end] = map_.range(static_cast<int>(i));
      if (first < end && !timeline_.pauses[i].bodies.empty())
        film_.freezes.push_back({i, seconds(first), seconds(end)});
    }
  }

  const Timeline& timeline_;
  double fps_;
  std::int64_t simulated_; ///< frames of 1/fps_ in the simulated time
  std::span<const double> narrations_;
  TimeMap map_;
  Film film_;
  std::vector<double> sectionStarts_;
  double cardEnd_ = 0.0;  ///< s of the video: until when the last title card stands
  std::string cardTitle_; ///< whose that is
  std::vector<Diagnostic> problems_;
};

} // namespace

Moment Film::moment(std::int64_t index) const {
  const double position = map->position(index);
  if (clock.isFixed()) {
    const double whole = std::floor(position);
    return {static_cast<std::int64_t>(whole), position - whole};
  }
  // A frame that is due within the rounding of its own time counts as due.
  const double time = std::min(position / fps, clock.duration());
  const std::int64_t frame = clock.frameAt(time + kTimeRounding);
  if (!map->isSlow(index) || frame >= clock.steps()) return {frame, 0.0};
  const double begin = clock.time(frame);
  const double length = clock.time(frame + 1) - begin;
  const double fraction = length > 0.0 ? (time - begin) / length : 0.0;
  return {frame, std::clamp(fraction, 0.0, 1.0 - 1e-9)};
}

double Film::videoTime(double simulated) const {
  return map ? map->inverse(simulated * fps) / fps : simulated;
}

Film makeFilm(const Timeline& timeline, const Clock& clock, std::span<const double> narrations,
              const std::string& title) {
  return FilmMaker(timeline, clock, narrations).make(title);
}

} // namespace offstage
