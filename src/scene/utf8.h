#pragma once

#include <string>
#include <string_view>

namespace offstage {

/// The characters of a text (RFC 3629). Throws Error(BadInput) at bytes that are not UTF-8.
std::u32string decodeUtf8(std::string_view text);

/// The text with U+FFFD for each byte that is not UTF-8: for what has to be UTF-8, whatever a file is called.
std::string repairedUtf8(std::string_view text);

/// One character as UTF-8.
std::string encodeUtf8(char32_t character);

} // namespace offstage
