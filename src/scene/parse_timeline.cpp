#include "src/scene/parse_timeline.h"

#include "src/scene/film.h"
#include "src/scene/limits.h"
#include "src/scene/quote.h"

#include <algorithm>

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr Choice<Highlight> kHighlights[] = {{"ring", Highlight::Ring}, {"dim", Highlight::Dim}};
constexpr Choice<Easing> kEasings[] = {
    {"smooth", Easing::Smooth}, {"linear", Easing::Linear}, {"in", Easing::In}, {"out", Easing::Out}};
constexpr double kMostZoom = 1000.0;

/// A table of a list that may not be longer than any scene needs.
template <class Item>
bool isTooMany(SceneBuilder& builder, const TomlValue& table, const std::vector<Item>& items,
               std::string_view label) {
  if (items.size() < kMaxTimelineTables) return false;
  if (!builder.errors.full())
    builder.errors.add(table, fmt::format("a scene has at most {} {} tables", kMaxTimelineTables, label));
  return true;
}

void parseFades(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"timeline"}, "[timeline]", builder.errors);
  Timeline& timeline = builder.scene.timeline;
  timeline.fadeIn = reader.number("fade_in", Range::between(0.0, kMaxPause));
  timeline.fadeOut = reader.number("fade_out", Range::between(0.0, kMaxPause));
  timeline.fadeColor = reader.color("fade_color");
}

void parsePause(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"pause"}, "[[pause]]", builder.errors);
  if (isTooMany(builder, table, builder.scene.timeline.pauses, "[[pause]]")) return;
  Pause pause;
  pause.at = reader.number("at", Range::atLeast(0.0));
  pause.length = reader.number("for", Range::aboveUpTo(0.0, kMaxPause));
  if (pause.at > builder.scene.clock.duration() + 1e-9 && !builder.scene.timeline.cut)
    reader.reject("at", fmt::format("is {} s of simulated time, but the scene ends at {} s",
                                    numberText(pause.at), numberText(builder.scene.clock.duration())));
  if (const TomlValue* names = reader.find("highlight")) {
    const std::string what = reader.described("highlight");
    if (names->array() == nullptr || names->array()->empty()) {
      reportMismatch(*names, what, "a list of names of bodies", builder.errors);
    } else {
      for (std::size_t i = 0; i < names->array()->size(); ++i) {
        const auto body = builder.findBody((*names->array())[i], fmt::format("value {} of {}", i + 1, what));
        if (body) pause.bodies.push_back(*body);
      }
    }
  }
  pause.highlight = reader.choice("style", kHighlights);
  pause.color = reader.color("color");
  builder.scene.timeline.pauses.push_back(std::move(pause));
}

void parseSpeed(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"speed"}, "[[speed]]", builder.errors);
  std::vector<SpeedChange>& speeds = builder.scene.timeline.speeds;
  if (isTooMany(builder, table, speeds, "[[speed]]")) return;
  SpeedChange speed;
  const double end = builder.scene.clock.duration();
  speed.from = reader.number("from", Range::atLeast(0.0));
  speed.to = reader.givenNumber("to", Range::above(0.0)).value_or(std::max(end, speed.from));
  speed.factor = reader.number("factor", Range::between(kSlowest, kFastest));
  if (reader.has("to") && !(speed.from < speed.to)) {
    reader.reject(
        "to", fmt::format("is {} s, not after 'from', {} s", numberText(speed.to), numberText(speed.from)));
    return;
  }
  if (!builder.scene.timeline.cut && reader.has("from")) {
    if (speed.from >= end)
      reader.reject("from", fmt::format("is {} s of simulated time, but the scene ends at {} s",
                                        numberText(speed.from), numberText(end)));
    else if (speed.to > end + 1e-9)
      reader.reject("to", fmt::format("is {} s of simulated time, but the scene ends at {} s",
                                      numberText(speed.to), numberText(end)));
  }
  const auto overlapping = std::ranges::find_if(
      speeds, [&](const SpeedChange& other) { return speed.from < other.to && other.from < speed.to; });
  if (overlapping != speeds.end())
    builder.errors.add(table, fmt::format("[[speed]] from {} s to {} s overlaps that from {} s to {} s",
                                          numberText(speed.from), numberText(speed.to),
                                          numberText(overlapping->from), numberText(overlapping->to)));
  speeds.insert(std::ranges::upper_bound(speeds, speed.from, {}, &SpeedChange::from), speed);
}

void parseCamera(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"camera"}, "[[camera]]", builder.errors);
  if (isTooMany(builder, table, builder.scene.timeline.camera, "[[camera]]")) return;
  CameraMove move;
  move.where = locationOf(builder.scene, table);
  move.at = reader.number("at", Range::between(0.0, kMaxDuration));
  move.length = reader.number("for", Range::between(0.0, kMaxPause));
  move.center.point = builder.scene.world.pane * 0.5;
  if (reader.has("center")) move.center = builder.readAnchor(reader, "center").value_or(move.center);
  move.zoom = reader.number("zoom", Range::between(1.0 / kMostZoom, kMostZoom));
  move.easing = reader.choice("easing", kEasings);
  move.section = readSectionName(builder, reader);
  builder.requireFinite(table, "[[camera]]", {move.center.point.x(), move.center.point.y()});
  builder.scene.timeline.camera.push_back(std::move(move));
}

void parseNarration(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"narration"}, "[narration]", builder.errors);
  Timeline& timeline = builder.scene.timeline;
  timeline.narrationStart = reader.number("start", Range::between(0.0, kMaxDuration));
  if (!reader.has("file")) reader.require("file");
  const auto file = builder.readFile(reader, "file");
  if (!file) return;
  timeline.narration =
      SoundFile{*file, locationOf(builder.scene, *reader.find("file")), reader.described("file")};
  for (const Section& section : timeline.sections) {
    if (!section.narration) continue;
    builder.errors.add(table,
                       fmt::format("[narration] is for the whole video, but the section in line {} has a "
                                   "narration of its own: give one or the other",
                                   section.where.line));
    return;
  }
}

void parseSound(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"sound"}, "[sound]", builder.errors);
  Timeline& timeline = builder.scene.timeline;
  timeline.clicks = reader.boolean("clicks");
  timeline.loudestClick = reader.number("loudest", Range::above(0.0));
  if (reader.has("loudest")) timeline.loudestClick = builder.view.length()(timeline.loudestClick);
  builder.requireFinite(table, "[sound]", {timeline.loudestClick});
}

void parsePoster(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"poster"}, "[poster]", builder.errors);
  builder.scene.timeline.poster = reader.givenNumber("at", Range::between(0.0, kMaxDuration));
  if (reader.has("at")) builder.scene.timeline.posterWhere = locationOf(builder.scene, *reader.find("at"));
}

/// Fades that meet, or are cut by the video's end, never let the whole picture be seen. A length that
/// the command line gives may do so.
void requireRoomForFades(SceneBuilder& builder, const TomlValue& table) {
  const Timeline& timeline = builder.scene.timeline;
  const double video = builder.videoSeconds;
  if (builder.lengthIsGiven || timeline.fadeIn + timeline.fadeOut <= video + 1e-9) return;
  const TableReader reader(table, {"timeline"}, "[timeline]", builder.errors);
  const bool out = timeline.fadeOut > 0.0;
  std::string what = fmt::format("is {} s", numberText(out ? timeline.fadeOut : timeline.fadeIn));
  if (out && timeline.fadeIn > 0.0) what += fmt::format(" and 'fade_in' {} s", numberText(timeline.fadeIn));
  reader.reject(out ? "fade_out" : "fade_in",
                fmt::format("{}, but the video lasts only {} s: the picture would never be there in full",
                            what, numberText(video)));
}

/// Whether how long the video is depends on sound files, which are not opened here.
bool hasNarration(const Timeline& timeline) {
  return timeline.narration || std::ranges::any_of(timeline.sections, [](const Section& section) {
           return section.narration.has_value();
         });
}

} // namespace

void parseTimeline(SceneBuilder& builder, const TableReader& top, const SceneOverrides& overrides) {
  Timeline& timeline = builder.scene.timeline;
  const Clock& clock = builder.scene.clock;
  if (clock.isFixed())
    timeline.fps = clock.fps();
  else if (overrides.fps)
    timeline.fps = *overrides.fps;
  timeline.cut = overrides.duration.has_value() || overrides.dtLog.has_value();

  const std::size_t errorsBefore = builder.errors.count();
  parseSingle(builder, top, "timeline", parseFades);
  parseEach(builder, top, "section", parseSection);
  std::ranges::sort(timeline.sections, {}, &Section::start);
  parseEach(builder, top, "caption", parseCaption);
  parseEach(builder, top, "pause", parsePause);
  parseEach(builder, top, "speed", parseSpeed);
  parseEach(builder, top, "camera", parseCamera);
  parseSingle(builder, top, "narration", parseNarration);
  parseSingle(builder, top, "sound", parseSound);
  parseSingle(builder, top, "poster", parsePoster);
  if (builder.scene.replay) {
    constexpr const char* kNothing = "needs events, but a [replay] simulates nothing";
    if (!timeline.eventCaptions.empty()) top.reject("caption", fmt::format("with 'on' {}", kNothing));
    if (timeline.clicks) top.reject("sound", fmt::format("with clicks {}", kNothing));
  }
  builder.videoSeconds = hasNarration(timeline) ? kMaxDuration : clock.duration();
  if (builder.errors.count() > errorsBefore || hasNarration(timeline) || clock.steps() == 0) return;
  try {
    builder.videoSeconds = makeFilm(timeline, clock, {}, builder.scene.title).seconds;
    if (const TomlValue* table = top.find("timeline")) requireRoomForFades(builder, *table);
  } catch (const SceneError& problems) {
    for (const Diagnostic& problem : problems.diagnostics())
      builder.errors.add(problem.where.line, problem.where.column, problem.message);
  }
  if (builder.videoSeconds > kMaxDuration)
    builder.errors.add(fmt::format("the video would last {} s, but at most {} s are allowed",
                                   numberText(builder.videoSeconds), numberText(kMaxDuration)));
}

} // namespace offstage
