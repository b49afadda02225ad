#include "render/job/sidecar.h"

#include "render/output/captions.h"
#include "render/output/file_error.h"
#include "render/output/output_kind.h"
#include "src/sim/error.h"

#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include <fmt/format.h>

namespace offstage {

std::optional<std::filesystem::path> Sidecar::nameFor(const std::filesystem::path& out) {
  const OutputKind kind = outputKind(out);
  if (isStream(kind) || kind == OutputKind::PngSequence) return std::nullopt;
  std::filesystem::path name = out;
  return name.replace_extension(".vtt");
}

Sidecar::Sidecar(const std::filesystem::path& out) : file_(nameFor(out).value()) {
  requireWritable(file_); // not a folder, and nothing that hangs when it is opened
  std::error_code ignored;
  if (std::filesystem::exists(file_, ignored)) {
    std::ifstream stream(file_, std::ios::binary);
    if (!isOwnWebVtt(std::string(std::istreambuf_iterator<char>(stream), {})))
      throw Error(
          ExitCode::BadInput,
          fmt::format("the captions go to {}, but a file is there that offstage has not made: move it away",
                      quoted(file_)));
  }
}

void Sidecar::write(const VideoTracks& tracks) const {
  AtomicFile file(file_);
  file.write(webVtt(tracks.captions));
  file.commit();
}

} // namespace offstage
