#pragma once

#include <span>
#include <string_view>

namespace offstage {

/// The key that is meant by one that none of these tables of a scene has, where no letters are mistyped but
/// the word is another program's, or another table's: "color" of a [[body]] is 'fill'. Empty when the word
/// says nothing.
std::string_view meantKey(std::string_view key, std::span<const std::string_view> tables);

} // namespace offstage
