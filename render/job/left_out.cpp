#include "render/job/left_out.h"

#include "render/job/sidecar.h"
#include "render/output/file_error.h"
#include "render/output/output_kind.h"

#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace offstage {

std::string leftOutNotice(const std::filesystem::path& out, const VideoTracks& tracks) {
  if (holdsSound(outputKind(out))) return {}; // and captions and chapters
  std::vector<std::string_view> names;
  if (tracks.sound) names.emplace_back("sound");
  if (!tracks.captions.empty() && !Sidecar::nameFor(out)) names.emplace_back("captions");
  if (!tracks.chapters.empty()) names.emplace_back("chapters");
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) list += i + 1 < names.size() ? ", " : " or ";
    list += names[i];
  }
  return list.empty() ? list : fmt::format("{} holds no {}", quoted(out.filename()), list);
}

} // namespace offstage
