#include "src/scene/body_cell.h"

#include "src/scene/diagnostic.h"
#include "src/scene/scene_keys.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <variant>

#include <fmt/core.h>

namespace offstage {
namespace {

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ') || text.starts_with('\t')) text.remove_prefix(1);
  while (text.ends_with(' ') || text.ends_with('\t')) text.remove_suffix(1);
  return text;
}

/// A text that is no value of TOML, as colours are: "#ff8000", "red". Those need not be tried, which takes as
/// long as everything else that is read of a body.
bool isBare(std::string_view text) {
  if (text.starts_with('#')) return true;
  const auto isLetter = [](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z');
  };
  return std::all_of(text.begin(), text.end(), isLetter) && text != "true" && text != "false" &&
         text != "inf" && text != "nan";
}

/// Takes a number off the front of `text`; all of it must be one where there is no `rest`.
std::optional<double> takeNumber(std::string_view text, std::string_view* rest) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [stopped, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc{} || !std::isfinite(value)) return std::nullopt;
  const auto used = static_cast<std::size_t>(stopped - text.data());
  if (rest != nullptr) {
    *rest = text.substr(used);
  } else if (used != text.size()) {
    return std::nullopt;
  }
  return value;
}

} // namespace

std::optional<double> numberInCell(std::string_view text) {
  return takeNumber(text, nullptr);
}

std::optional<std::array<double, 2>> pairInCell(std::string_view text) {
  if (text.starts_with('[') && text.ends_with(']')) text = trimmed(text.substr(1, text.size() - 2));
  const auto first = takeNumber(text, &text);
  if (!first) return std::nullopt;
  std::string_view rest = trimmed(text);
  if (rest.starts_with(',')) {
    rest = trimmed(rest.substr(1));
  } else if (rest.size() == text.size()) {
    return std::nullopt; // nothing stands between the two
  }
  const auto second = takeNumber(rest, nullptr);
  if (!second) return std::nullopt;
  return std::array{*first, *second};
}

TomlValue cellValue(std::string_view key, std::string_view text, std::uint32_t line, std::uint32_t column) {
  const auto spec =
      std::find_if(sceneKeyTable().begin(), sceneKeyTable().end(), [&](const SceneKey& candidate) {
        return candidate.table == "body" && candidate.key == key;
      });
  if (spec->type == "string" || spec->type == "choice" || isBare(text))
    return {std::string(text), line, column};
  const auto relocate = [&](auto& self, TomlValue& value) -> void {
    value.line = line;
    value.column = column;
    if (auto* array = std::get_if<TomlValue::Array>(&value.data)) {
      for (TomlValue& element : *array) self(self, element);
    } else if (auto* table = std::get_if<TomlValue::Table>(&value.data)) {
      for (TomlEntry& entry : *table) {
        entry.line = line;
        entry.column = column;
        self(self, entry.value);
      }
    }
  };
  Diagnostic ignored;
  const std::optional<TomlValue> parsed = parseToml(fmt::format("v = {}", text), "", ignored);
  TomlValue value{std::string(text), line, column};
  if (parsed && parsed->table()->size() == 1) value = parsed->table()->front().value;
  relocate(relocate, value);
  return value;
}

} // namespace offstage
