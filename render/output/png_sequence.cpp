#include "render/output/png_sequence.h"

#include "render/output/atomic_file.h"
#include "render/output/file_error.h"
#include "render/output/frame_check.h"
#include "src/sim/error.h"

#include <algorithm>
#include <span>
#include <system_error>

#include <fmt/format.h>

namespace offstage {

namespace fs = std::filesystem;

namespace {

void makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error && !fs::is_directory(folder)) throw fileError(error.value(), folder);
}

} // namespace

PngSequenceSink::PngSequenceSink(const fs::path& pattern, const SinkFormat& format)
    : pattern_(pattern), format_(format) {
  makeFolder(pattern_.folder());
  requireWritable(pattern_.path(0));
}

void PngSequenceSink::write(const Frame& frame, const FrameTiming& timing) {
  requireFrameSize(frame, format_.width, format_.height);
  if (timing.index < 0)
    throw Error(ExitCode::BadInput, fmt::format("a frame has the number {}", timing.index));
  AtomicFile file(pattern_.path(timing.index));
  const std::span<const std::uint8_t> png = encoder_.encode(frame, format_.alpha);
  file.write(png.data(), png.size());
  file.commit(AtomicFile::SyncFolder::No);
  bytes_ += static_cast<std::int64_t>(png.size());
  ++frames_;
  highestNumber_ = std::max(highestNumber_, timing.index);
}

void PngSequenceSink::finish() {
  if (frames_ == 0)
    throw Error(ExitCode::BadInput, fmt::format("no frames to write to {}", quoted(pattern_.path(0))));
  syncFolder(pattern_.folder());
}

std::string PngSequenceSink::notice() const {
  std::int64_t others = 0;
  std::error_code error;
  for (fs::directory_iterator entry(pattern_.folder(), error), end; !error && entry != end;
       entry.increment(error)) {
    const std::optional<std::int64_t> number = pattern_.numberOf(entry->path().filename().native());
    if (number && *number > highestNumber_) ++others;
  }
  if (frames_ == 0 || others == 0) return {};
  return fmt::format("{} holds {} frame{} of an earlier run with higher numbers than {}",
                     quoted(pattern_.folder()), others, others == 1 ? "" : "s", highestNumber_);
}

} // namespace offstage
