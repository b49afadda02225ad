// [[section]] and [[caption]]: the texts that stand beside the pictures.

#include "src/scene/nearest.h"
#include "src/scene/parse_timeline.h"
#include "src/scene/quote.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include <fmt/core.h>

namespace offstage {
namespace {

/// A set of kinds of events, a bit each.
template <class... Kinds>
constexpr std::uint32_t bits(Kinds... kinds) {
  return ((1U << static_cast<unsigned>(kinds)) | ...);
}

/// What may start a caption. "bounce" is any of the pane's edges.
constexpr Choice<std::uint32_t> kEvents[] = {
    {"bounce", bits(EventKind::Left, EventKind::Right, EventKind::Top, EventKind::Bottom)},
    {"left", bits(EventKind::Left)},
    {"right", bits(EventKind::Right)},
    {"top", bits(EventKind::Top)},
    {"bottom", bits(EventKind::Bottom)},
    {"collide", bits(EventKind::Collide)},
    {"hit", bits(EventKind::Hit)},
    {"touch", bits(EventKind::Touch)},
    {"spawn", bits(EventKind::Spawn)},
    {"fire", bits(EventKind::Fire)},
    {"leave", bits(EventKind::Leave)},
};

/// A text that is shown as it is: no control characters but line ends (\n, or \r\n, which becomes \n),
/// something to see, and not too long. Line ends only where `lines`.
std::optional<std::string> readText(const TableReader& reader, std::string_view key, std::size_t most,
                                    bool lines) {
  const auto given = reader.givenString(key);
  if (!given) return std::nullopt;
  if (given->size() > most) {
    reader.reject(key, fmt::format("holds {} bytes, but at most {} are allowed", given->size(), most));
    return std::nullopt;
  }
  std::string text;
  for (std::size_t i = 0; i < given->size(); ++i) {
    const char c = (*given)[i];
    if (c == '\r' && i + 1 < given->size() && (*given)[i + 1] == '\n') continue;
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && !(lines && c == '\n')) || byte == 0x7f) {
      reader.reject(key, fmt::format("holds the control character {}", printable(std::string_view(&c, 1))));
      return std::nullopt;
    }
    text += c;
  }
  if (text.find_first_not_of(" \n") == std::string::npos) {
    reader.reject(key, "holds nothing to see");
    return std::nullopt;
  }
  return text;
}

std::string textOr(const std::optional<std::string>& text) {
  return text.value_or(std::string());
}

void readTimes(SceneBuilder& builder, const TableReader& reader, Caption& caption) {
  const Range time = Range::between(0.0, kMaxDuration);
  const auto from = reader.givenNumber("from", time);
  const auto to = reader.givenNumber("to", time);
  const double length = reader.number("for", Range::aboveUpTo(0.0, kMaxDuration));
  reader.rejectBoth("for", "to");
  caption.from = from.value_or(0.0);
  caption.to = to ? *to : caption.from + length;
  if (from && to && !(*from < *to))
    reader.reject("to", fmt::format("is {} s, not after 'from', {} s", numberText(*to), numberText(*from)));
  caption.section = readSectionName(builder, reader);
}

void readEvent(SceneBuilder& builder, const TableReader& reader, std::string text) {
  EventCaption caption;
  caption.text = std::move(text);
  const std::uint32_t kinds = reader.givenChoice("on", kEvents).value_or(0);
  for (unsigned kind = 0; kinds >> kind != 0; ++kind)
    if ((kinds >> kind & 1U) != 0) caption.kinds.push_back(static_cast<EventKind>(kind));
  for (const char* key : {"from", "to", "section"}) reader.rejectBoth(key, "on");
  caption.length = reader.number("for", Range::aboveUpTo(0.0, kMaxDuration));
  caption.limit = reader.givenInteger("limit", 1, std::numeric_limits<std::int64_t>::max());
  if (const TomlValue* body = reader.find("body"))
    caption.body = builder.findBody(*body, reader.described("body"));
  builder.scene.timeline.eventCaptions.push_back(std::move(caption));
}

} // namespace

std::optional<std::size_t> readSectionName(SceneBuilder& builder, const TableReader& reader) {
  const auto title = reader.givenString("section");
  if (!title) return std::nullopt;
  const std::vector<Section>& sections = builder.scene.timeline.sections;
  const auto found = std::ranges::find(sections, *title, &Section::title);
  if (found != sections.end()) return static_cast<std::size_t>(found - sections.begin());
  std::vector<std::string_view> titles;
  titles.reserve(sections.size());
  for (const Section& section : sections) titles.emplace_back(section.title);
  const std::string_view near = nearest(*title, titles);
  reader.reject("section",
                fmt::format("names {}, but no [[section]] has this title{}", quotedText(*title),
                            near.empty() ? "" : fmt::format("; did you mean {}?", quotedText(near))));
  return std::nullopt;
}

void parseSection(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"section"}, "[[section]]", builder.errors);
  std::vector<Section>& sections = builder.scene.timeline.sections;
  Section section;
  section.where = locationOf(builder.scene, table);
  if (!reader.has("title")) reader.require("title");
  section.title = textOr(readText(reader, "title", kMaxSectionBytes, false));
  section.start = reader.number("start", Range::between(0.0, kMaxDuration));
  section.card = reader.givenNumber("card", Range::between(0.0, kMaxPause)).value_or(0.0);
  section.subtitle = textOr(readText(reader, "subtitle", kMaxCaptionBytes, true));
  if (reader.has("narration")) {
    const auto file = builder.readFile(reader, "narration");
    if (file)
      section.narration = SoundFile{*file, locationOf(builder.scene, *reader.find("narration")),
                                    reader.described("narration")};
  }
  const auto twin = std::ranges::find_if(sections, [&](const Section& other) {
    return other.title == section.title || other.start == section.start;
  });
  if (twin != sections.end() && reader.has("title") && reader.has("start"))
    builder.errors.add(table,
                       fmt::format("[[section]] has the {} of that in line {}",
                                   twin->title == section.title ? "title" : "start", twin->where.line));
  if (sections.size() == kMaxSections)
    builder.errors.add(table, fmt::format("a scene has at most {} sections", kMaxSections));
  if (sections.size() <= kMaxSections) sections.push_back(std::move(section));
}

void parseCaption(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"caption"}, "[[caption]]", builder.errors);
  Timeline& timeline = builder.scene.timeline;
  if (!reader.has("text")) reader.require("text");
  std::string text = textOr(readText(reader, "text", kMaxCaptionBytes, true));
  if (timeline.captions.size() + timeline.eventCaptions.size() >= kMaxCaptions) {
    if (!builder.errors.full())
      builder.errors.add(table, fmt::format("a scene has at most {} captions", kMaxCaptions));
    return;
  }
  if (reader.has("on")) {
    readEvent(builder, reader, std::move(text));
    return;
  }
  if (!reader.has("from")) builder.errors.add(table, "[[caption]] needs 'from' or 'on'");
  for (const char* key : {"body", "limit"})
    if (reader.has(key)) reader.reject(key, "needs 'on' beside it");
  Caption caption;
  caption.where = locationOf(builder.scene, table);
  caption.text = std::move(text);
  readTimes(builder, reader, caption);
  timeline.captions.push_back(std::move(caption));
}

} // namespace offstage
