#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace offstage {

// Scenes nest both four deep at most.
inline constexpr std::size_t kMaxDotsInKey = 16;
inline constexpr std::size_t kMaxNestedValues = 16;

/// The first place of a TOML text that is nested too deep.
struct TooDeep {
  std::uint32_t line = 1;   ///< from 1
  std::uint32_t column = 1; ///< from 1, in code points
  bool isKey = true;        ///< a key with more than kMaxDotsInKey dots; else brackets within brackets
};

/// Looks for the place at which a key gets more than kMaxDotsInKey dots, or arrays and inline tables stand in
/// each other more than kMaxNestedValues deep. toml++ (up to 3.3) limits the nesting of values to 256 but not
/// that of dotted keys, `a.a.a.…`, each of which makes a table in a table, and the two multiply: the
/// recursion over a hostile file's tables would overflow the stack. Strings and comments are skipped by
/// TOML's rules; what comes after a syntax error does not matter, because toml++ stops there.
std::optional<TooDeep> findTooDeep(std::string_view text);

} // namespace offstage
