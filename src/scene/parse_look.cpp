#include "src/scene/parse_look.h"

#include <optional>
#include <utility>

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr Choice<StrokeAlign> kAligns[] = {
    {"centered", StrokeAlign::Centered}, {"inside", StrokeAlign::Inside}, {"outside", StrokeAlign::Outside}};

/// The keys image, anchor and proportional of a fill or a stroke.
std::optional<ImagePattern> readPattern(SceneBuilder& builder, const TableReader& reader) {
  ImagePattern pattern;
  pattern.proportional = reader.boolean("proportional");
  if (const auto anchor = reader.givenNumbers<4>("anchor")) {
    if ((*anchor)[2] > 0.0 && (*anchor)[3] > 0.0) {
      pattern.anchor = *anchor;
    } else {
      reader.reject("anchor", "must have a width and a height greater than 0: [x, y, width, height]");
    }
  } else if (!pattern.proportional && !reader.has("anchor")) {
    reader.reject("proportional",
                  "can be false only beside an 'anchor', the rectangle in px that holds one image");
  }
  const auto file = builder.readFile(reader, "image");
  if (!file) return std::nullopt;
  pattern.file = *file;
  const TomlValue& image = *reader.find("image");
  pattern.where = locationOf(builder.scene, image);
  return pattern;
}

std::vector<Paint> readCycle(const TableReader& reader) {
  for (const char* other : {"image", "anchor", "proportional"}) {
    if (reader.has(other))
      reader.reject(other, "cannot stand beside 'fill.cycle': a cycle is of colours only");
  }
  const TomlValue& cycle = *reader.find("cycle");
  const std::string what = reader.described("cycle");
  std::vector<Paint> paints;
  if (cycle.array() == nullptr || cycle.array()->empty()) {
    reportMismatch(cycle, what, "a list of at least one colour", reader.errors());
    return paints;
  }
  for (std::size_t i = 0; i < cycle.array()->size(); ++i) {
    const std::string whatElement = fmt::format("value {} of {}", i + 1, what);
    if (const auto color = readColor((*cycle.array())[i], whatElement, reader.errors()))
      paints.emplace_back(*color);
  }
  return paints;
}

/// The fills that follow each other; nothing in them: not filled.
std::vector<std::optional<Paint>> readFills(SceneBuilder& builder, const TableReader& reader, bool mayCycle) {
  const TomlValue* fill = reader.find("fill");
  if (const auto* text = std::get_if<std::string>(&fill->data)) {
    if (*text == "none") return {std::nullopt};
    return {readColor(*fill, {reader, "fill"}, builder.errors).value_or(Color{})};
  }
  if (fill->table() == nullptr) {
    reportMismatch(*fill, reader.described("fill"),
                   "a colour, \"none\" or a table such as { image = \"x.png\" }", builder.errors);
    return {Look{}.fill};
  }
  const TableReader keys(*fill, {"fill"}, reader.label(), builder.errors, "fill.");
  if (keys.has("cycle") && !mayCycle) {
    keys.reject("cycle", "belongs where there are many bodies, in [[spawn]], [replay] and a look of a group");
  } else if (keys.has("cycle")) {
    const std::vector<Paint> paints = readCycle(keys);
    if (!paints.empty()) return {paints.begin(), paints.end()};
  } else if (!keys.has("image")) {
    keys.require("image");
  } else if (auto pattern = readPattern(builder, keys)) {
    return {std::move(*pattern)};
  }
  return {Look{}.fill};
}

std::optional<Stroke> readStroke(SceneBuilder& builder, const TableReader& reader) {
  const TomlValue* value = reader.find("stroke");
  if (value == nullptr) return std::nullopt;
  if (value->table() == nullptr) {
    reportMismatch(*value, reader.described("stroke"), "a table such as { color = \"black\", width = 1.0 }",
                   builder.errors);
    return std::nullopt;
  }
  const TableReader keys(*value, {"stroke"}, reader.label(), builder.errors, "stroke.");
  Stroke stroke;
  stroke.width = keys.number("width", Range::atLeast(0.0));
  stroke.align = keys.choice("align", kAligns);
  if (keys.has("image")) {
    keys.rejectBoth("color", "image");
    if (auto pattern = readPattern(builder, keys)) stroke.paint = std::move(*pattern);
    return stroke;
  }
  stroke.paint = keys.color("color");
  for (const char* ofImages : {"anchor", "proportional"}) {
    if (keys.has(ofImages)) keys.reject(ofImages, "needs a 'stroke.image' that it places");
  }
  return stroke;
}

} // namespace

std::vector<std::uint32_t> readLooks(SceneBuilder& builder, const TableReader& reader, const Body& body,
                                     bool mayCycle) {
  Look look = bodyLook(builder.scene.theme, body.group, body.fixed, builder.scene.size[1]);
  look.opacity = reader.number("opacity", Range::between(0.0, 1.0));
  // The theme's edge belongs to its fill.
  if (reader.has("fill") || reader.has("stroke")) look.stroke = readStroke(builder, reader);
  if (!reader.has("fill")) return {builder.looks.add(look)};
  std::vector<std::uint32_t> indices;
  for (auto& fill : readFills(builder, reader, mayCycle)) {
    look.fill = std::move(fill);
    indices.push_back(builder.looks.add(look));
  }
  return indices;
}

} // namespace offstage
