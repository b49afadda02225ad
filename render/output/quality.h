#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace offstage {

/// How closely a video keeps its frames, against its size and the time to make it.
enum class Quality : std::uint8_t {
  Draft,    ///< to look at once
  Good,     ///< the default: no difference to see at normal size
  High,     ///< for editing and projection
  Lossless, ///< every pixel as drawn
};

std::string_view qualityName(Quality quality);               ///< "draft", "good", "high", "lossless"
std::optional<Quality> qualityOfName(std::string_view name); ///< nothing for another word

} // namespace offstage
