#pragma once

#include "src/scene/toml_value.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace offstage {

// What a cell of a body table says. Nothing when it says something else.

std::optional<double> numberInCell(std::string_view text); ///< a finite one
/// "[320, 440]", "320, 440" or "320 440".
std::optional<std::array<double, 2>> pairInCell(std::string_view text);

/// A cell as the value that this key of [[body]] would have in a scene, with the cell's place in the file.
/// Strings stand without quotes.
TomlValue cellValue(std::string_view key, std::string_view text, std::uint32_t line, std::uint32_t column);

} // namespace offstage
