#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace offstage {

/// Scenes nest keys three deep at most.
inline constexpr std::size_t kMaxDotsInKey = 16;

struct TextPosition {
  std::uint32_t line = 1;   ///< from 1
  std::uint32_t column = 1; ///< from 1, in code points
};

/// The first place of a TOML text at which a key gets more than kMaxDotsInKey dots. toml++ limits the nesting
/// of values but (up to 3.3) not that of dotted keys, `a.a.a.…`, each of which makes a table in a table: the
/// recursion over a hostile file's tables would overflow the stack. Strings and comments are skipped by
/// TOML's rules; what comes after a syntax error does not matter, because toml++ stops there.
std::optional<TextPosition> findTooDeepKey(std::string_view text);

} // namespace offstage
