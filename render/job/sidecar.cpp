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
namespace {

bool isOwn(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return isOwnWebVtt(std::string(std::istreambuf_iterator<char>(stream), {}));
}

} // namespace

std::optional<std::filesystem::path> Sidecar::nameFor(const std::filesystem::path& out) {
  const OutputKind kind = outputKind(out);
  if (isStream(kind) || kind == OutputKind::PngSequence) return std::nullopt;
  std::filesystem::path name = out;
  return name.replace_extension(".vtt");
}

Sidecar::Sidecar(const std::filesystem::path& out) : file_(nameFor(out).value()) {
  requireWritable(file_); // not a folder, and nothing that hangs when it is opened
  std::error_code ignored;
  if (std::filesystem::exists(file_, ignored) && !isOwn(file_))
    throw Error(
        ExitCode::BadInput,
        fmt::format("the captions go to {}, but a file is there that offstage has not made: move it away",
                    quoted(file_)));
}

void Sidecar::removeStale(const std::filesystem::path& out) {
  const std::optional<std::filesystem::path> file = nameFor(out);
  std::error_code error; // what cannot be looked at is not there, or somebody else's
  // A link was made by somebody, and a pipe would not end.
  if (!file || !std::filesystem::is_regular_file(std::filesystem::symlink_status(*file, error)) ||
      !isOwn(*file))
    return;
  std::filesystem::remove(*file, error);
  if (error) throw fileError(error.value(), *file);
}

void Sidecar::write(const VideoTracks& tracks) const {
  AtomicFile file(file_);
  file.write(webVtt(tracks.captions));
  file.commit();
}

} // namespace offstage
