#pragma once

#include <string>
#include <string_view>

namespace offstage {

/// `text` as a JSON string with its quotes (RFC 8259): quotes, backslashes and control characters
/// escaped, U+FFFD for bytes that are not UTF-8.
std::string jsonText(std::string_view text);

} // namespace offstage
