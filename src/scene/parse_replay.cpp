#include "src/scene/parse_replay.h"

#include "src/scene/limits.h"
#include "src/scene/nearest.h"
#include "src/scene/parse_look.h"
#include "src/scene/quote.h"
#include "src/scene/replay.h"

#include <limits>
#include <map>
#include <set>
#include <utility>

#include <fmt/core.h>

namespace offstage {
namespace {

/// Body::id holds no more.
constexpr std::int64_t kLargestId = std::numeric_limits<std::uint32_t>::max();

/// Looks of bodies: of one by its id, of a group's by turns.
struct LookRules {
  std::vector<std::uint32_t> otherwise; ///< by turns, of [replay] itself
  std::map<std::int64_t, std::uint32_t> byId;
  std::map<std::uint32_t, std::vector<std::uint32_t>> byGroup;
};

void rejectTablesThatMove(const TableReader& top) {
  if (top.has("clock")) top.reject("clock", "cannot stand beside [replay], whose trace has the times");
  for (const char* key :
       {"world", "walls", "input", "view", "body", "bodies", "spawn", "launch", "collide", "force"}) {
    if (top.has(key)) top.reject(key, "cannot stand beside [replay], which simulates nothing");
  }
}

std::optional<Trace> readTraceOf(SceneBuilder& builder, const TableReader& reader) {
  if (!reader.has("trace")) {
    reader.require("trace");
    return std::nullopt;
  }
  const auto file = builder.readFile(reader, "trace");
  if (!file) return std::nullopt;
  try {
    Trace trace = readTrace(*file);
    if (trace.rows.empty()) {
      reader.reject("trace", "names a trace without rows, so there is nothing to show");
      return std::nullopt;
    }
    for (const TraceRow& row : trace.rows) {
      if (row.id >= 0 && row.id <= kLargestId) continue;
      builder.errors.add(SceneError(
          {{{trace.file, row.line, 1},
            fmt::format("the ids of a replay are from 0 to {}, but here one is {}", kLargestId, row.id)}}));
      return std::nullopt;
    }
    return trace;
  } catch (const SceneError& problems) {
    builder.errors.add(problems);
  }
  return std::nullopt;
}

std::optional<std::uint32_t> findGroup(const TableReader& reader, const Trace& trace,
                                       const std::string& name) {
  for (std::size_t i = 0; i < trace.groups.size(); ++i) {
    if (trace.groups[i] == name) return static_cast<std::uint32_t>(i);
  }
  const std::vector<std::string_view> known(trace.groups.begin(), trace.groups.end());
  const std::string_view near = nearest(name, known);
  reader.reject("group",
                fmt::format("names {}, a group that the trace does not have{}", quotedText(name),
                            near.empty() ? "" : fmt::format("; did you mean {}?", quotedText(near))));
  return std::nullopt;
}

/// One [[replay.look]]. Its paint is read even where its body is wrong, so that all errors are told.
void readLookRule(SceneBuilder& builder, const TomlValue& table, const Trace* trace,
                  const std::set<std::int64_t>& ids, LookRules& rules) {
  const TableReader reader(table, {"replay.look"}, "[[replay.look]]", builder.errors);
  const auto id = reader.givenInteger("id", 0, kLargestId);
  const auto group = reader.givenString("group");
  if (!reader.has("id") && !reader.has("group"))
    builder.errors.add(table, "[[replay.look]] needs 'id' or 'group'");
  reader.rejectBoth("id", "group");
  const std::vector<std::uint32_t> looks = readLooks(builder, reader, Body{}, reader.has("group"));
  if (trace == nullptr) return;
  if (id && !ids.contains(*id)) {
    reader.reject("id", fmt::format("is {}, a body that the trace does not have", *id));
  } else if (id && !rules.byId.emplace(*id, looks.front()).second) {
    reader.reject("id", fmt::format("is {}, which has a look already", *id));
  }
  if (!group) return;
  if (const auto index = findGroup(reader, *trace, *group);
      index && !rules.byGroup.emplace(*index, looks).second)
    reader.reject("group", fmt::format("names {}, which has a look already", quotedText(*group)));
}

LookRules readLookRules(SceneBuilder& builder, const TableReader& reader, const Trace* trace) {
  LookRules rules;
  rules.otherwise = readLooks(builder, reader, Body{}, true);
  std::set<std::int64_t> ids;
  if (trace != nullptr) {
    for (const TraceRow& row : trace->rows) ids.insert(row.id);
  }
  const TomlValue* list = reader.find("look");
  if (list == nullptr) return rules;
  if (list->array() == nullptr || list->array()->empty()) {
    reportMismatch(*list, reader.described("look"), "an array of tables, [[replay.look]]", builder.errors);
    return rules;
  }
  for (const TomlValue& element : *list->array()) {
    if (element.table() == nullptr) {
      reportMismatch(element, "every value of " + reader.described("look"), "a table", builder.errors);
    } else {
      readLookRule(builder, element, trace, ids, rules);
    }
  }
  return rules;
}

/// Gives every group without a look of its own the theme's colour, unless the replay says how bodies look.
void addThemeLooks(SceneBuilder& builder, const TableReader& reader, const Trace& trace, LookRules& rules) {
  if (!builder.scene.theme.bodies || reader.has("fill") || reader.has("stroke")) return;
  for (std::uint32_t group = 0; group < trace.groups.size(); ++group) {
    Look look = bodyLook(builder.scene.theme, group, false, builder.scene.size[1]);
    look.opacity = reader.number("opacity", Range::between(0.0, 1.0));
    rules.byGroup.emplace(group, std::vector<std::uint32_t>{builder.looks.add(look)});
  }
}

/// The look of each row: of its body's id, or else of its group, or else the replay's. Where a paint has
/// turns, the bodies take them in the order of their first frames.
std::vector<std::uint32_t> looksOf(const Trace& trace, const LookRules& rules) {
  std::map<std::int64_t, std::uint32_t> lookOf;
  std::map<std::uint32_t, std::size_t> turns; // by group
  std::size_t turn = 0;
  std::vector<std::uint32_t> looks;
  looks.reserve(trace.rows.size());
  for (const TraceRow& row : trace.rows) {
    const auto [place, isNew] = lookOf.try_emplace(row.id, 0);
    if (isNew) {
      const auto ofGroup = rules.byGroup.find(row.group);
      if (const auto ofId = rules.byId.find(row.id); ofId != rules.byId.end()) {
        place->second = ofId->second;
      } else if (ofGroup != rules.byGroup.end()) {
        place->second = ofGroup->second[turns[row.group]++ % ofGroup->second.size()];
      } else {
        place->second = rules.otherwise[turn++ % rules.otherwise.size()];
      }
    }
    looks.push_back(place->second);
  }
  return looks;
}

void setClock(SceneBuilder& builder, const TableReader& top, const std::vector<Replay::Frame>& frames,
              const SceneOverrides& overrides) {
  // A rate given for this run resamples, as it does a recorded clock.
  const Clock clock = replayClock(frames, !overrides.fps);
  std::optional<double> duration = overrides.duration; // parseClock() has held both to their range
  if (!duration && top.has("duration")) duration = top.number("duration");
  builder.scene.clock = duration ? clock.truncated(clock.frameAt(*duration)) : clock;
}

} // namespace

void parseReplay(SceneBuilder& builder, const TomlValue& table, const TableReader& top,
                 const SceneOverrides& overrides) {
  const TableReader reader(table, {"replay"}, "[replay]", builder.errors);
  rejectTablesThatMove(top);
  if (overrides.dtLog) builder.errors.add("a dt log cannot be given for a replay, whose trace has the times");
  auto trace = readTraceOf(builder, reader);
  LookRules rules = readLookRules(builder, reader, trace ? &*trace : nullptr);
  const auto start = reader.givenNumber("start");
  if (!trace) return;
  addThemeLooks(builder, reader, *trace, rules);
  const double end = trace->frames.back().time;
  if (start && *start > end) {
    reader.reject("start",
                  fmt::format("is {} s, but the trace ends at {} s", numberText(*start), numberText(end)));
    return;
  }
  if (end - start.value_or(trace->frames.front().time) > kMaxDuration) {
    reader.reject(start ? "start" : "trace",
                  fmt::format("gives a replay of more than {} s", numberText(kMaxDuration)));
    return;
  }
  auto replay = std::make_shared<Replay>();
  replay->frames = replayFrames(*trace, start);
  replay->looks = looksOf(*trace, rules);
  setClock(builder, top, replay->frames, overrides);
  replay->trace = std::move(*trace);
  builder.scene.replay = std::move(replay);
}

} // namespace offstage
