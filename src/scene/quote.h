#pragma once

#include <string>
#include <string_view>

namespace offstage {

/// A user's text as a message shows it: in double quotes, cut to a readable length, control characters and
/// bytes that are not UTF-8 as \xNN, so that a message stays one line and never carries a terminal's escape
/// sequences.
std::string quotedText(std::string_view text);

/// A number in the shortest form that reads back to the same bits: "0.1", "20", "nan".
std::string numberText(double value);

} // namespace offstage
