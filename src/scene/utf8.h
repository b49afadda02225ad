#pragma once

#include <string>
#include <string_view>

namespace offstage {

/// The characters of a text (RFC 3629). Throws Error(BadInput) at bytes that are not UTF-8.
std::u32string decodeUtf8(std::string_view text);

/// One character as UTF-8.
std::string encodeUtf8(char32_t character);

} // namespace offstage
