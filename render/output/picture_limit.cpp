#include "render/output/picture_limit.h"

#include "render/output/file_error.h"
#include "src/sim/error.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include <fmt/format.h>

namespace offstage {

int mostCodedHeight(int width) {
  constexpr std::int64_t kMargin = 128;
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max() - 1;
  return static_cast<int>(std::max<std::int64_t>(kMost / ((width + kMargin) * 8) - kMargin, 0));
}

void requireCodedSize(const std::filesystem::path& out, std::string_view what, int mostSide, int width,
                      int height) {
  std::string limit;
  if (width > mostSide || height > mostSide)
    limit = fmt::format("at most {} px a side", mostSide);
  else if (height > mostCodedHeight(width))
    limit = fmt::format("at this width at most {} px of height", mostCodedHeight(width));
  else
    return;
  throw Error(ExitCode::BadInput,
              fmt::format("{}: {} holds {}, not {} × {}; use a smaller --size or --scale, a PNG sequence "
                          "(frames/%06d.png) or .raw",
                          quoted(out), what, limit, width, height));
}

} // namespace offstage
