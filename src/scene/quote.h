#pragma once

#include <string>
#include <string_view>

namespace offstage {

/// A user's text with control characters and bytes that are not UTF-8 as \xNN, so that a message stays one
/// line and never carries a terminal's escape sequences.
std::string printable(std::string_view text);

/// The same in double quotes and cut to a readable length.
std::string quotedText(std::string_view text);

/// A number as a message shows it, in the shortest form that reads back to the same bits: "0.1", "1000000",
/// "1e+300", "nan".
std::string numberText(double value);

} // namespace offstage
