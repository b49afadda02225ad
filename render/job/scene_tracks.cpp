#include "render/job/scene_tracks.h"

#include "render/job/interrupt.h"
#include "render/output/sound_mix.h"
#include "render/output/sound_reader.h"
#include "src/scene/quote.h"
#include "src/sim/contact.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace offstage {
namespace {

/// Slower contacts than this share of the loudest one are not heard: a ball that lies on the floor touches it
/// in every frame.
constexpr double kInaudible = 0.04;

std::int64_t nanoseconds(double seconds) {
  return std::llround(seconds * 1e9);
}

[[noreturn]] void rejectSound(const SoundFile& sound, const Error& error) {
  if (error.code() != ExitCode::BadInput) throw error;
  throw SceneError({{sound.where, fmt::format("{} names the file {}, which {}", sound.key,
                                              quotedText(sound.file.string()), error.what())}});
}

std::shared_ptr<SoundReader> openSound(const SoundFile& sound) {
  try {
    return std::make_shared<SoundReader>(sound.file);
  } catch (const Error& error) {
    rejectSound(sound, error);
  }
}

const Body* findBody(std::span<const Body> bodies, std::int64_t id) {
  const auto found = std::ranges::find(bodies, id, [](const Body& body) { return std::int64_t{body.id}; });
  return found == bodies.end() ? nullptr : &*found;
}

/// How two things that touch in a step were before it.
struct Approach {
  double gap;   ///< px between them; < 0 where they overlap
  double speed; ///< px/s at which it shrinks
};

Approach approachToEdge(EventKind edge, const Body& body, const Vec2& pane) {
  const int axis = edge == EventKind::Left || edge == EventKind::Right ? 0 : 1;
  const double at = body.position[axis];
  const double speed = body.velocity[axis];
  const bool circle = body.shape == Shape::Circle;
  if (edge == EventKind::Left || edge == EventKind::Top) return {at - (circle ? body.radius : 0.0), -speed};
  return {pane[axis] - at - (circle ? body.radius : body.size[axis]), speed};
}

Approach approachOf(const Body& first, const Body& second) {
  const std::optional<Contact> contact = findContact(first, second, HUGE_VAL);
  if (!contact) return {0.0, 0.0}; // a coordinate is NaN
  return {contact->distance - contact->touch, closingSpeed(*contact, first, second)};
}

/// Captions that events show, while the events come by.
class EventCaptions {
public:
  EventCaptions(const Timeline& timeline, const Film& film) : film_(film) {
    for (const EventCaption& caption : timeline.eventCaptions) states_.push_back({&caption, -HUGE_VAL, 0});
  }

  /// `shown`: s of simulated time, see shownAt().
  void take(const Event& event, double shown) {
    for (State& state : states_) {
      const EventCaption& caption = *state.caption;
      if (std::ranges::count(caption.kinds, event.kind) == 0) continue;
      if (caption.body && event.first != *caption.body && event.second != *caption.body) continue;
      if (caption.limit && state.shown >= *caption.limit) continue;
      const double time = film_.videoTime(shown);
      if (time < state.until || time >= film_.seconds) continue;
      state.until = time + caption.length;
      ++state.shown;
      if (captions_.size() >= kMaxCaptions)
        throw Error(
            ExitCode::BadInput,
            fmt::format(
                "events show more than {} captions: give their [[caption]] a longer 'for' or a 'limit'",
                kMaxCaptions));
      Caption& made = captions_.emplace_back();
      made.text = caption.text;
      made.from = time;
      made.to = state.until;
    }
  }

  std::vector<Caption> captions() && { return std::move(captions_); }

private:
  struct State {
    const EventCaption* caption;
    double until; ///< s of the video: it is shown up to then, and does not come again before
    std::int64_t shown;
  };
  const Film& film_;
  std::vector<State> states_;
  std::vector<Caption> captions_;
};

/// What of from … to lies in the part of the video that begins at `origin` and lasts `length`, in ns since
/// `origin`.
std::optional<std::pair<std::int64_t, std::int64_t>> cut(double from, double to, double origin,
                                                         double length) {
  const std::int64_t first = std::max<std::int64_t>(nanoseconds(from - origin), 0);
  const std::int64_t last = std::min(nanoseconds(to - origin), nanoseconds(length));
  if (first >= last) return std::nullopt;
  return std::pair(first, last);
}

std::vector<PlacedSound> voicesOf(const Film& film, double origin) {
  std::vector<PlacedSound> voices;
  for (const Film::Voice& voice : film.voices)
    voices.push_back({openSound(voice.sound), std::llround((voice.start - origin) * kSoundRate)});
  return voices;
}

} // namespace

bool needsEvents(const Timeline& timeline) {
  return timeline.clicks || !timeline.eventCaptions.empty();
}

std::vector<double> narrationLengths(const Timeline& timeline) {
  std::vector<double> lengths;
  const auto add = [&lengths](const std::optional<SoundFile>& sound) {
    if (!sound) return;
    const std::shared_ptr<SoundReader> reader = openSound(*sound);
    try {
      lengths.push_back(static_cast<double>(countSamples(*reader)) / kSoundRate);
    } catch (const Error& error) {
      rejectSound(*sound, error);
    }
  };
  for (const Section& section : timeline.sections) add(section.narration);
  add(timeline.narration);
  return lengths;
}

std::vector<ContactMoment> contactsOf(const World& after, std::span<const Body> before, double timeBefore) {
  std::vector<ContactMoment> contacts;
  for (const Event& event : after.events()) {
    const Body* first = findBody(before, event.first);
    if (first == nullptr) continue;
    Approach approach{};
    double speed = 0.0;
    switch (event.kind) {
    case EventKind::Left:
    case EventKind::Right:
    case EventKind::Top:
    case EventKind::Bottom:
      approach = approachToEdge(event.kind, *first, after.setup().pane);
      speed = std::abs(event.q);
      break;
    case EventKind::Collide:
    case EventKind::Hit: {
      const Body* second = findBody(before, event.second);
      if (second == nullptr) continue;
      approach = approachOf(*first, *second);
      speed = event.kind == EventKind::Collide ? event.q : approach.speed; // a hit does not say how fast
      break;
    }
    default:
      continue;
    }
    if (!(speed > 0.0)) continue;
    const double mean = 0.5 * (std::max(approach.speed, 0.0) + speed);
    const double passed = std::clamp(approach.gap / mean, 0.0, after.time() - timeBefore);
    contacts.push_back({timeBefore + passed, speed});
  }
  return contacts;
}

double shownAt(const World& after, double timeBefore, const Tick& tick, double time) {
  const Stepping& stepping = after.setup().stepping;
  if (stepping.form == Stepping::Form::Accumulator) return time + stepping.dt;
  const double length = after.time() - timeBefore;
  return length > 0.0 ? tick.time - tick.dt * ((after.time() - time) / length) : tick.time;
}

VideoTracks sceneTracks(const Timeline& timeline, const Film& film, const World* start, double from,
                        double to) {
  VideoTracks tracks;
  const double length = to - from;
  tracks.end = nanoseconds(length);
  std::vector<Caption> captions = film.captions;
  std::vector<Click> clicks;
  if (start != nullptr) {
    EventCaptions shown(timeline, film);
    World world(*start);
    std::vector<Body> before;
    for (std::int64_t frame = 1; frame <= film.clock.steps(); ++frame) {
      throwIfInterrupted();
      const Tick tick = film.clock.tick(frame);
      if (timeline.clicks) before.assign(world.bodies().begin(), world.bodies().end());
      const double timeBefore = world.time();
      world.step(tick);
      const auto clockTime = [&](double time) { return shownAt(world, timeBefore, tick, time); };
      for (const Event& event : world.events()) shown.take(event, clockTime(event.time));
      if (!timeline.clicks) continue;
      for (const ContactMoment& contact : contactsOf(world, before, timeBefore)) {
        const double share = contact.speed / timeline.loudestClick;
        if (share >= kInaudible)
          clicks.push_back({film.videoTime(clockTime(contact.time)) - from, std::min(share, 1.0)});
      }
    }
    for (Caption& caption : std::move(shown).captions()) captions.push_back(std::move(caption));
    std::ranges::stable_sort(captions, {}, &Caption::from);
    std::ranges::stable_sort(clicks, {}, &Click::time);
  }
  for (Caption& caption : captions)
    if (const auto part = cut(caption.from, caption.to, from, length))
      tracks.captions.push_back({part->first, part->second, std::move(caption.text)});
  for (const Film::Chapter& chapter : film.chapters)
    if (const auto part = cut(chapter.start, chapter.end, from, length))
      tracks.chapters.push_back({part->first, part->second, chapter.title});
  if (!film.voices.empty() || timeline.clicks)
    tracks.sound = std::make_shared<SoundMix>(voicesOf(film, from), std::move(clicks),
                                              std::llround(length * kSoundRate));
  return tracks;
}

} // namespace offstage
