#pragma once

#include <string>

namespace offstage {

/// `text` as one word of a POSIX shell's command line: quoted where it holds anything but letters, digits and
/// the harmless of the other characters.
std::string shellWord(const std::string& text);

} // namespace offstage
