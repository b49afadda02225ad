#include "src/scene/toml_value.h"

#include "src/scene/quote.h"
#include "src/scene/toml_depth.h"

#include <utility>

#include <fmt/core.h>

// Compiled here, not linked: the shared library reads every number through a stream and its locale, which
// takes longer than all the rest of a large scene.
#define TOML_HEADER_ONLY 1
#define TOML_FLOAT_CHARCONV 1
#include <toml++/toml.h>

namespace offstage {
namespace {

TomlValue converted(const toml::node& node);

TomlValue::Table convertedTable(const toml::table& table) {
  TomlValue::Table entries;
  entries.reserve(table.size());
  for (const auto& [key, value] : table) {
    const toml::source_position begin = key.source().begin;
    entries.push_back({std::string(key.str()), begin.line, begin.column, converted(value)});
  }
  return entries;
}

TomlValue converted(const toml::node& node) {
  TomlValue value;
  value.line = node.source().begin.line;
  value.column = node.source().begin.column;
  if (const auto* table = node.as_table()) {
    value.data = convertedTable(*table);
  } else if (const auto* array = node.as_array()) {
    TomlValue::Array elements;
    elements.reserve(array->size());
    for (const toml::node& element : *array) elements.push_back(converted(element));
    value.data = std::move(elements);
  } else if (const auto* text = node.as_string()) {
    value.data = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.data = std::int64_t{integer->get()};
  } else if (const auto* real = node.as_floating_point()) {
    value.data = real->get();
  } else if (const auto* truth = node.as_boolean()) {
    value.data = truth->get();
  } else {
    value.data = TomlValue::DateTime{};
  }
  return value;
}

} // namespace

std::string TomlValue::description() const {
  struct Describe {
    std::string operator()(bool value) const { return value ? "true" : "false"; }
    std::string operator()(std::int64_t value) const { return std::to_string(value); }
    std::string operator()(double value) const {
      const std::string text = numberText(value);
      const bool looksWhole = text.find_first_not_of("-0123456789") == std::string::npos;
      return looksWhole ? text + ".0" : text; // "must be an integer, but it is 1" would puzzle
    }
    std::string operator()(const std::string& value) const { return "the string " + quotedText(value); }
    std::string operator()(const DateTime& /*value*/) const { return "a date or time"; }
    std::string operator()(const Array& value) const {
      if (value.empty()) return "an empty array";
      return fmt::format("an array of {} value{}", value.size(), value.size() == 1 ? "" : "s");
    }
    std::string operator()(const Table& /*value*/) const { return "a table"; }
  };
  return std::visit(Describe{}, data);
}

std::optional<TomlValue> parseToml(std::string_view text, const std::string& file, Diagnostic& error) {
  if (const auto tooDeep = findTooDeep(text)) {
    error = {{file, tooDeep->line, tooDeep->column},
             tooDeep->isKey ? fmt::format("a key may have at most {} dots", kMaxDotsInKey)
                            : fmt::format("values may be nested at most {} deep", kMaxNestedValues)};
    return std::nullopt;
  }
  try {
    return converted(toml::parse(text, std::string_view(file)));
  } catch (const toml::parse_error& problem) {
    const toml::source_position begin = problem.source().begin;
    error = {{file, begin.line, begin.column}, "not valid TOML: " + printable(problem.description())};
    return std::nullopt;
  }
}

} // namespace offstage
