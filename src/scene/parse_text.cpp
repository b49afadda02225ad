#include "src/scene/parse_text.h"

#include "src/scene/limits.h"
#include "src/scene/parse_template.h"
#include "src/scene/quote.h"

#include <algorithm>

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr double kDefaultShareOfHeight = 1.0 / 20.0;

constexpr Choice<Typeface> kTypefaces[] = {{"sans", Typeface::Sans},
                                           {"sans-bold", Typeface::SansBold},
                                           {"mono", Typeface::Mono},
                                           {"mono-bold", Typeface::MonoBold}};
constexpr Choice<TextAlign> kAligns[] = {
    {"left", TextAlign::Left}, {"center", TextAlign::Center}, {"right", TextAlign::Right}};

/// The keys place, at and offset.
void readPlace(SceneBuilder& builder, const TableReader& reader, TextItem& item) {
  item.offset = toVec2(reader.pair("offset"));
  item.place = reader.givenChoice("place", kNinePositions);
  if (reader.rejectBoth("at", "place")) return;
  if (reader.has("place")) return;
  if (!reader.has("at")) {
    builder.errors.add(reader.value(), fmt::format("{} needs 'at' or 'place'", reader.label()));
    return;
  }
  if (const auto at = builder.readAnchor(reader, "at")) item.at = *at;
}

void readLook(SceneBuilder& builder, const TableReader& reader, TextItem& item) {
  TextLook& look = item.look;
  look.font = readFont(builder, reader, "font");
  look.size = reader.givenNumber("size", Range::between(kLeastTextSize, kMostTextSize))
                  .value_or(defaultTextSize(builder));
  look.color = readGivenColor(reader, "color").value_or(builder.scene.theme.text);
  look.opacity = reader.number("opacity", Range::between(0.0, 1.0));
  look.anchor =
      reader.givenChoice("anchor", kNinePositions).value_or(item.place.value_or(NinePosition::Center));
  look.align = reader.givenChoice("align", kAligns).value_or(sideOf(look.anchor));
  look.lineHeight = reader.number("line_height", Range::between(0.5, 5.0));
  look.background = readGivenColor(reader, "background");
  look.padding = reader.number("padding", Range::between(0.0, 10.0));
  look.outline = readGivenColor(reader, "outline");
  look.outlineWidth = reader.number("outline_width", Range::between(0.0, 0.5));
  look.upwards = reader.boolean("upwards");
  for (const auto& [key, of] : {std::pair("padding", "background"), std::pair("outline_width", "outline")}) {
    if (reader.has(key) && !reader.has(of))
      reader.reject(key, fmt::format("needs the colour '{}' beside it", of));
  }
}

void readTimes(const SceneBuilder& builder, const TableReader& reader, TextItem& item) {
  item.from = reader.number("from", Range::between(0.0, kMaxDuration));
  if (item.from > builder.videoSeconds + 1e-9 && !builder.lengthIsGiven)
    reader.reject("from", fmt::format("is {} s, but the video ends at {} s", numberText(item.from),
                                      numberText(builder.videoSeconds)));
  item.fade = reader.number("fade", Range::between(0.0, kMaxDuration));
  const auto to = reader.givenNumber("to", Range::between(0.0, kMaxDuration));
  if (!to) return;
  item.to = *to;
  if (item.to <= item.from) {
    reader.reject("to", fmt::format("must be after 'from', but it is {} and 'from' {}", numberText(item.to),
                                    numberText(item.from)));
  } else if (2.0 * item.fade > item.to - item.from) {
    const TomlValue& at = reader.has("fade") ? *reader.find("fade") : *reader.find("to");
    reader.errors().add(at, fmt::format("{} must be at most half of the time from 'from' to 'to', {} s",
                                        reader.described("fade"), numberText(item.to - item.from)));
  }
}

/// The key formula. What concerns letters has no effect on it, so it may not stand beside it.
bool readFormula(const TableReader& reader, TextItem& item) {
  for (const char* ofLetters : {"font", "align", "line_height", "outline", "outline_width", "upwards"}) {
    if (reader.has(ofLetters)) reader.reject(ofLetters, "belongs to a 'text', not to a 'formula'");
  }
  const auto formula = reader.givenString("formula");
  if (!formula) return false;
  if (formula->size() > kMaxTextBytes) {
    reader.reject("formula", fmt::format("may hold at most {} bytes", kMaxTextBytes));
    return false;
  }
  // "\theta" in double quotes is a tab and "heta" for TOML, and TeX would take the tab for a space.
  const auto escape = std::ranges::find_if(
      *formula, [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r'; });
  if (escape != formula->end()) {
    reader.reject(
        "formula",
        fmt::format("holds the control character U+{:04X}, which \"\\t\", \"\\f\" or \"\\b\" stands for "
                    "in double quotes: write it in single ones, '\\theta'",
                    static_cast<unsigned>(static_cast<unsigned char>(*escape))));
    return false;
  }
  item.formula = *formula;
  return true;
}

/// The key text or formula. True when it is right.
bool readContent(SceneBuilder& builder, const TableReader& reader, TextItem& item) {
  const TomlValue* formula = reader.find("formula");
  const TomlValue* text = reader.find("text");
  if (text == nullptr && formula == nullptr) {
    builder.errors.add(reader.value(), fmt::format("{} needs 'text' or 'formula'", reader.label()));
    return false;
  }
  const TomlValue& content = formula != nullptr ? *formula : *text;
  item.where = locationOf(builder.scene, content);
  if (reader.rejectBoth("formula", "text")) return false;
  if (formula != nullptr) return readFormula(reader, item);
  auto read = readTemplate(builder, *text, reader.described("text"));
  if (!read) return false;
  item.text = std::move(*read);
  return true;
}

} // namespace

double defaultTextSize(const SceneBuilder& builder) {
  return std::max(kDefaultShareOfHeight * builder.scene.size[1], kLeastTextSize);
}

std::optional<Color> readGivenColor(const TableReader& reader, std::string_view key) {
  const TomlValue* value = reader.find(key);
  if (value == nullptr) return std::nullopt;
  return readColor(*value, reader.described(key), reader.errors());
}

FontChoice readFont(SceneBuilder& builder, const TableReader& reader, std::string_view key) {
  FontChoice font;
  const auto name = reader.givenString(key);
  if (!name) return font;
  const bool isFile = name->find_first_of("./") != std::string::npos;
  if (!isFile) {
    font.typeface = reader.givenChoice(key, kTypefaces).value_or(Typeface::Sans);
    return font;
  }
  const TomlValue& value = *reader.find(key);
  font.where = locationOf(builder.scene, value);
  font.file = builder.readFile(reader, key).value_or(std::filesystem::path());
  return font;
}

void parseText(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"text"}, "[[text]]", builder.errors);
  if (builder.scene.texts.size() == kMaxTexts) {
    builder.errors.add(table, fmt::format("a scene has at most {} texts", kMaxTexts));
    return;
  }
  TextItem item;
  readPlace(builder, reader, item);
  readLook(builder, reader, item);
  readTimes(builder, reader, item);
  if (readContent(builder, reader, item)) builder.scene.texts.push_back(std::move(item));
}

double shownShare(const TextItem& item, double time) {
  if (time < item.from || time >= item.to) return 0.0;
  if (!(item.fade > 0.0)) return 1.0;
  return std::clamp(std::min(time - item.from, item.to - time) / item.fade, 0.0, 1.0);
}

} // namespace offstage
