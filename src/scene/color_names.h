#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace offstage {

/// A colour name of CSS Color Module Level 4, section 6.1, with its value 0xrrggbb.
struct NamedColor {
  std::string_view name; ///< lower case
  std::uint32_t rgb;
};

/// All 148 of them in alphabetical order ("transparent" is none of them: it has no rgb).
std::span<const NamedColor> namedColors();

} // namespace offstage
