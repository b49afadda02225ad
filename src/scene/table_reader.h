#pragma once

#include "src/scene/error_list.h"
#include "src/scene/range.h"
#include "src/scene/scene.h"
#include "src/scene/toml_value.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace offstage {

/// One word that a key may hold, and what it stands for.
template <typename Value>
struct Choice {
  std::string_view word;
  Value value;
};

/// Reads one table of a scene, key by key. Every accessor reports what is wrong with its key to the ErrorList
/// and then returns something usable (the key's default, or nothing), so that a parser simply goes on and all
/// errors are found. Keys, defaults and which keys are required come from sceneKeyTable(); asking for a key
/// that is not in it is a bug of the program and throws std::logic_error.
class TableReader {
public:
  /// `tables`: the names in sceneKeyTable() whose keys may stand here. Reports unknown keys at once.
  /// `label`: how messages name the table, "[[body]]"; empty for the top level.
  /// `prefix`: what stands before the key in messages, "fill." for a table within a table.
  TableReader(const TomlValue& value, std::initializer_list<std::string_view> tables, std::string label,
              ErrorList& errors, std::string prefix = "");

  [[nodiscard]] const TomlValue* find(std::string_view key) const; ///< null when absent
  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
  [[nodiscard]] const TomlValue& value() const { return value_; }
  [[nodiscard]] ErrorList& errors() const { return errors_; }
  [[nodiscard]] const std::string& label() const { return label_; }
  [[nodiscard]] std::string described(std::string_view key) const; ///< `'fill.image' in [[body]]`

  // The given value; without one, or with a wrong one, the key's default. A missing required key is reported.
  double number(std::string_view key, Range range = Range::any()) const;
  std::int64_t integer(std::string_view key, std::int64_t low, std::int64_t high) const;
  bool boolean(std::string_view key) const;
  std::string string(std::string_view key) const; ///< not empty
  Color color(std::string_view key) const;
  std::array<double, 2> pair(std::string_view key, Range range = Range::any()) const;

  /// The same, where it matters whether the key was given. Nothing is reported when it was not.
  std::optional<double> givenNumber(std::string_view key, Range range = Range::any()) const;
  std::optional<std::int64_t> givenInteger(std::string_view key, std::int64_t low, std::int64_t high) const;
  std::optional<std::string> givenString(std::string_view key) const;
  template <std::size_t N>
  std::optional<std::array<double, N>> givenNumbers(std::string_view key, Range range = Range::any()) const {
    std::array<double, N> numbers{};
    if (!readNumbers(key, numbers, range)) return std::nullopt;
    return numbers;
  }

  /// One of a few words.
  template <typename Value, std::size_t N>
  std::optional<Value> givenChoice(std::string_view key, const Choice<Value> (&choices)[N]) const {
    std::array<std::string_view, N> words;
    for (std::size_t i = 0; i < N; ++i) words[i] = choices[i].word;
    const auto index = readChoice(key, words);
    if (!index) return std::nullopt;
    return choices[*index].value;
  }
  template <typename Value, std::size_t N>
  Value choice(std::string_view key, const Choice<Value> (&choices)[N]) const {
    if (const auto given = givenChoice(key, choices)) return *given;
    const std::string word = defaultString(key);
    for (const Choice<Value>& candidate : choices) {
      if (candidate.word == word) return candidate.value;
    }
    return choices[0].value;
  }

  /// Reports that the key is missing; for keys whose need depends on others.
  void require(std::string_view key) const;
  /// Reports `problem` at the key's value, or at the table when its default is meant: "'size' in [[body]] " +
  /// problem.
  void reject(std::string_view key, std::string_view problem) const;
  /// Reports when both keys are given. True when so.
  bool rejectBoth(std::string_view key, std::string_view other) const;

private:
  [[nodiscard]] const SceneKey& spec(std::string_view key) const;
  [[nodiscard]] const TomlValue* entry(std::string_view key) const; ///< null when absent; of a known key
  // The key's default. That a required key is missing is reported.
  [[nodiscard]] std::string_view defaultOf(std::string_view key) const;
  [[nodiscard]] std::string defaultString(std::string_view key) const; ///< without quotation marks
  void reportUnknownKeys() const;
  [[nodiscard]] std::string unknownKeyHint(const std::string& key) const;
  bool readNumbers(std::string_view key, std::span<double> numbers, Range range) const;
  std::optional<std::size_t> readChoice(std::string_view key, std::span<const std::string_view> words) const;

  const TomlValue& value_;
  std::vector<std::string_view> tables_;
  std::string label_;
  std::string prefix_;
  ErrorList& errors_;
};

/// How messages name a value. It is put into words only for a message: a scene of ten thousand bodies has
/// hundred thousand values that nothing is wrong with. Refers to what it is made from.
class ValueName {
public:
  ValueName(const std::string& text) : text_(text) {} // NOLINT(google-explicit-constructor): a name as it is
  ValueName(const TableReader& table, std::string_view key) : table_(&table), text_(key) {}
  /// "value 2 of …": an element of an array, counted from 0 here.
  ValueName(std::size_t index, const ValueName& array) : array_(&array), index_(index) {}
  [[nodiscard]] std::string text() const;

private:
  const TableReader* table_ = nullptr;
  const ValueName* array_ = nullptr;
  std::string_view text_; ///< the key, of a table
  std::size_t index_ = 0;
};

// One value, wherever it stands. Each reports what is wrong with it as "`what` must be …, but it is …".
std::optional<double> readNumber(const TomlValue& value, const ValueName& what, Range range,
                                 ErrorList& errors);
std::optional<std::int64_t> readInteger(const TomlValue& value, const ValueName& what, std::int64_t low,
                                        std::int64_t high, ErrorList& errors);
std::optional<Color> readColor(const TomlValue& value, const ValueName& what, ErrorList& errors);
/// As many numbers as `numbers` has places; an array of another length is an error. True when all are right.
bool readNumbers(const TomlValue& value, const ValueName& what, std::span<double> numbers, Range range,
                 ErrorList& errors);
/// "`what` must be `wanted`, but it is …".
void reportMismatch(const TomlValue& value, const std::string& what, std::string_view wanted,
                    ErrorList& errors);

} // namespace offstage
