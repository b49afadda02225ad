#include "src/scene/table_reader.h"

#include "src/scene/meant_key.h"
#include "src/scene/nearest.h"
#include "src/scene/quote.h"
#include "src/scene/scene_keys.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr std::string_view kRequired = "required";

/// The numbers of a default's text: "60", "[0, 9.8]".
void parseDefaults(std::string_view text, std::span<double> numbers) {
  const char* place = text.data();
  const char* const end = text.data() + text.size();
  for (double& number : numbers) {
    while (place != end && (*place == '[' || *place == ',' || *place == ' ')) ++place;
    place = std::from_chars(place, end, number).ptr; // stays 0 where the default is no number
  }
}

/// A table of sceneKeyTable() as a user writes it.
std::string tableLabel(std::string_view table) {
  constexpr std::string_view kForce = "force.";
  if (table.empty()) return "the top of the file";
  if (table == "fill" || table == "stroke") return fmt::format("'{}'", table);
  if (table == "random") return "a random number";
  if (table.starts_with(kForce)) return fmt::format("a force of type \"{}\"", table.substr(kForce.size()));
  for (const SceneKey& key : sceneKeyTable()) {
    if (key.table.empty() && key.key == table && key.type == "tables") return fmt::format("[[{}]]", table);
  }
  return fmt::format("[{}]", table);
}

} // namespace

TableReader::TableReader(const TomlValue& value, std::initializer_list<std::string_view> tables,
                         std::string label, ErrorList& errors, std::string prefix)
    : value_(value), tables_(tables), label_(std::move(label)), prefix_(std::move(prefix)), errors_(errors) {
  reportUnknownKeys();
}

const SceneKey& TableReader::spec(std::string_view key) const {
  for (const SceneKey* candidate : sceneKeysNamed(key)) {
    if (std::find(tables_.begin(), tables_.end(), candidate->table) != tables_.end()) return *candidate;
  }
  throw std::logic_error(fmt::format("the list of scene keys lacks '{}' of {}", key, label_));
}

const TomlValue* TableReader::find(std::string_view key) const {
  static_cast<void>(spec(key)); // a key that the list lacks would be reported as unknown and never be read
  return entry(key);
}

const TomlValue* TableReader::entry(std::string_view key) const {
  const auto* table = value_.table();
  if (table == nullptr) return nullptr;
  for (const TomlEntry& entry : *table) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

std::string TableReader::described(std::string_view key) const {
  if (label_.empty()) return fmt::format("'{}{}'", prefix_, key);
  return fmt::format("'{}{}' in {}", prefix_, key, label_);
}

std::string_view TableReader::defaultOf(std::string_view key) const {
  const std::string_view text = spec(key).defaultText;
  if (text == kRequired && entry(key) == nullptr) require(key);
  return text;
}

std::string TableReader::defaultString(std::string_view key) const {
  std::string_view text = defaultOf(key);
  if (text.size() >= 2 && text.front() == '"') text = text.substr(1, text.size() - 2);
  return std::string(text);
}

void TableReader::require(std::string_view key) const {
  const std::string table = label_.empty() ? "the scene" : label_;
  errors_.add(value_, fmt::format("{} needs '{}{}'", table, prefix_, key));
}

void TableReader::reject(std::string_view key, std::string_view problem) const {
  const TomlValue* given = find(key);
  errors_.add(given != nullptr ? *given : value_, fmt::format("{} {}", described(key), problem));
}

bool TableReader::rejectBoth(std::string_view key, std::string_view other) const {
  if (!has(key) || !has(other)) return false;
  reject(key, fmt::format("cannot stand beside '{}{}': give one of the two", prefix_, other));
  return true;
}

double TableReader::number(std::string_view key, Range range) const {
  if (const auto given = givenNumber(key, range)) return *given;
  double number = 0.0;
  parseDefaults(defaultOf(key), {&number, 1});
  return number;
}

std::int64_t TableReader::integer(std::string_view key, std::int64_t low, std::int64_t high) const {
  if (const auto given = givenInteger(key, low, high)) return *given;
  double number = 0.0;
  parseDefaults(defaultOf(key), {&number, 1});
  return static_cast<std::int64_t>(number);
}

bool TableReader::boolean(std::string_view key) const {
  if (const TomlValue* given = find(key)) {
    if (const bool* truth = std::get_if<bool>(&given->data)) return *truth;
    reportMismatch(*given, described(key), "true or false", errors_);
  }
  return defaultOf(key) == "true";
}

std::string TableReader::string(std::string_view key) const {
  if (const auto given = givenString(key)) return *given;
  return defaultString(key);
}

Color TableReader::color(std::string_view key) const {
  if (const TomlValue* given = find(key)) {
    if (const auto color = readColor(*given, {*this, key}, errors_)) return *color;
  }
  return parseColor(defaultString(key)).value_or(Color{});
}

std::array<double, 2> TableReader::pair(std::string_view key, Range range) const {
  if (const auto given = givenNumbers<2>(key, range)) return *given;
  std::array<double, 2> numbers{};
  parseDefaults(defaultOf(key), numbers);
  return numbers;
}

std::optional<double> TableReader::givenNumber(std::string_view key, Range range) const {
  const TomlValue* given = find(key);
  if (given == nullptr) return std::nullopt;
  return readNumber(*given, {*this, key}, range, errors_);
}

std::optional<std::int64_t> TableReader::givenInteger(std::string_view key, std::int64_t low,
                                                      std::int64_t high) const {
  const TomlValue* given = find(key);
  if (given == nullptr) return std::nullopt;
  return readInteger(*given, {*this, key}, low, high, errors_);
}

std::optional<std::string> TableReader::givenString(std::string_view key) const {
  const TomlValue* given = find(key);
  if (given == nullptr) return std::nullopt;
  const auto* text = std::get_if<std::string>(&given->data);
  if (text == nullptr) {
    reportMismatch(*given, described(key), "a string", errors_);
    return std::nullopt;
  }
  if (text->empty()) {
    reject(key, "must not be empty");
    return std::nullopt;
  }
  return *text;
}

bool TableReader::readNumbers(std::string_view key, std::span<double> numbers, Range range) const {
  const TomlValue* given = find(key);
  return given != nullptr && offstage::readNumbers(*given, {*this, key}, numbers, range, errors_);
}

std::optional<std::size_t> TableReader::readChoice(std::string_view key,
                                                   std::span<const std::string_view> words) const {
  const TomlValue* given = find(key);
  if (given == nullptr) return std::nullopt;
  const auto* text = std::get_if<std::string>(&given->data);
  if (text != nullptr) {
    const auto found = std::find(words.begin(), words.end(), *text);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  }
  std::string wanted;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) wanted += i + 1 == words.size() ? " or " : ", ";
    wanted += fmt::format("\"{}\"", words[i]);
  }
  const std::string_view near = text != nullptr ? nearest(*text, words) : std::string_view();
  const std::string hint = near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near);
  errors_.add(*given, fmt::format("{} must be {}, but it is {}{}", described(key), wanted,
                                  given->description(), hint));
  return std::nullopt;
}

void TableReader::reportUnknownKeys() const {
  const auto* table = value_.table();
  if (table == nullptr) return;
  for (const TomlEntry& entry : *table) {
    if (errors_.full()) return;
    const auto named = sceneKeysNamed(entry.key);
    const bool known = std::any_of(named.begin(), named.end(), [&](const SceneKey* candidate) {
      return std::find(tables_.begin(), tables_.end(), candidate->table) != tables_.end();
    });
    if (known) continue;
    const std::string place = label_.empty() ? "" : " in " + label_;
    const std::string quotedKey = quotedText(prefix_ + entry.key);
    const std::string shown = quotedKey.substr(1, quotedKey.size() - 2); // the message has its own quotes
    errors_.add(entry.line, entry.column,
                fmt::format("unknown key '{}'{}; {}", shown, place, unknownKeyHint(entry.key)));
  }
}

/// The key of this table that is called so elsewhere; else where the key belongs, when it is another table's;
/// else the nearest key of this one; else all of its keys.
std::string TableReader::unknownKeyHint(const std::string& key) const {
  if (const std::string_view meant = meantKey(key, tables_); !meant.empty())
    return fmt::format("did you mean '{}{}'?", prefix_, meant);
  std::string owners;
  std::vector<std::string_view> keys;
  for (const SceneKey& candidate : sceneKeyTable()) {
    if (std::find(tables_.begin(), tables_.end(), candidate.table) != tables_.end()) {
      keys.push_back(candidate.key);
    } else if (candidate.key == key) {
      owners += (owners.empty() ? "" : " or ") + tableLabel(candidate.table);
    }
  }
  if (!owners.empty()) return fmt::format("'{}' belongs to {}", key, owners);
  const std::string_view near = nearest(key, keys);
  if (!near.empty()) return fmt::format("did you mean '{}{}'?", prefix_, near);
  std::string allowed;
  for (const std::string_view candidate : keys) {
    allowed += fmt::format("{}'{}'", allowed.empty() ? "" : ", ", candidate);
  }
  return "allowed are " + allowed;
}

} // namespace offstage
