#pragma once

#include <string>

namespace offstage {

/// Prints each line of a notice on stderr, as "offstage: LINE".
void printNotice(const std::string& notice);

} // namespace offstage
