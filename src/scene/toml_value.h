#pragma once

#include "src/scene/diagnostic.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace offstage {

struct TomlEntry;

/// A value of a TOML 1.0 file with the place where it stands. The one part of the program that knows toml++
/// is parseToml(); everything after it reads this tree.
struct TomlValue {
  struct DateTime {}; ///< a date or a time: no key of a scene takes one
  using Array = std::vector<TomlValue>;
  using Table = std::vector<TomlEntry>;

  std::variant<bool, std::int64_t, double, std::string, DateTime, Array, Table> data;
  std::uint32_t line = 0;   ///< from 1; of a table its header
  std::uint32_t column = 0; ///< from 1, in code points

  [[nodiscard]] const Table* table() const { return std::get_if<Table>(&data); }
  [[nodiscard]] const Array* array() const { return std::get_if<Array>(&data); }
  /// What the value is, with its article and, where that is short, itself: `the string "red"`, `the number
  /// 3`, `a table`. Fits behind "but it is".
  [[nodiscard]] std::string description() const;
};

/// One `key = value` of a table.
struct TomlEntry {
  std::string key;
  std::uint32_t line = 0; ///< of the key
  std::uint32_t column = 0;
  TomlValue value;
};

/// Reads a TOML document. At a syntax error (invalid UTF-8 and duplicate keys included) nothing is returned
/// and `error` says what and where: TOML cannot be read on past it.
std::optional<TomlValue> parseToml(std::string_view text, const std::string& file, Diagnostic& error);

} // namespace offstage
