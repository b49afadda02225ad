#include "render/job/notice.h"

#include "render/job/console.h"

#include <cstdio>
#include <sstream>

#include <fmt/format.h>

namespace offstage {

void printNotice(const std::string& notice) {
  std::istringstream lines(notice);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) say(stderr, fmt::format("offstage: {}\n", line));
}

} // namespace offstage
