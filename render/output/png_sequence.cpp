#include "render/output/png_sequence.h"

#include "render/output/atomic_file.h"
#include "render/output/byte_order.h"
#include "render/output/chunk_file.h"
#include "render/output/file_error.h"
#include "render/output/frame_check.h"
#include "render/output/output_kind.h"
#include "render/output/png.h"
#include "src/sim/error.h"

#include <array>
#include <optional>
#include <span>
#include <system_error>
#include <vector>

#include <fmt/format.h>

namespace offstage {

namespace fs = std::filesystem;

namespace {

void makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error && !fs::is_directory(folder)) throw fileError(error.value(), folder);
}

/// A frame that is done: its number and its file's size in bytes.
struct DoneFrame {
  std::int64_t number = 0;
  std::int64_t bytes = 0;
};

/// Reads the next frame of a chunk's file; nothing at its end.
std::optional<DoneFrame> nextFrame(ChunkFileReader& reader, std::vector<std::uint8_t>& record) {
  if (!reader.next(record)) return std::nullopt;
  if (record.size() != 2 * sizeof(std::int64_t))
    throw Error(ExitCode::Transient, "a chunk holds a damaged record");
  const std::span<const std::uint8_t> bytes(record);
  return DoneFrame{fromLittleEndian<std::int64_t>(bytes), fromLittleEndian<std::int64_t>(bytes.subspan(8))};
}

class PngChunkWriter : public ChunkWriter {
public:
  PngChunkWriter(const fs::path& file, const FramePattern& pattern, const SinkFormat& format,
                 std::int64_t firstFrame)
      : pattern_(pattern), format_(format), order_(firstFrame, false), file_(file) {}

  void write(const Frame& frame, const FrameTiming& timing) override {
    requireFrameSize(frame, format_.width, format_.height);
    order_.require(timing);
    AtomicFile file(pattern_.path(timing.index));
    const std::span<const std::uint8_t> png = encoder_.encode(frame, format_.alpha);
    file.write(png.data(), png.size());
    file.commit(AtomicFile::SyncFolder::No);
    const auto number = littleEndian(timing.index);
    const auto size = littleEndian(static_cast<std::int64_t>(png.size()));
    std::array<std::uint8_t, number.size() + size.size()> record{};
    std::ranges::copy(number, record.begin());
    std::ranges::copy(size, record.begin() + number.size());
    file_.add(record);
    bytes_ += static_cast<std::int64_t>(png.size());
  }

  void skip(const FrameTiming& timing) override { order_.require(timing); }

  void finish() override {
    syncFolder(pattern_.folder());
    file_.commit();
  }

  [[nodiscard]] std::int64_t bytesWritten() const override { return bytes_; }

private:
  const FramePattern& pattern_;
  const SinkFormat& format_;
  FrameOrder order_;
  ChunkFileWriter file_;
  PngEncoder encoder_;
  std::int64_t bytes_ = 0;
};

} // namespace

PngSequenceOutput::PngSequenceOutput(const fs::path& pattern, const SinkFormat& format)
    : pattern_(pattern), format_(format) {
  if (format.quality && *format.quality != Quality::Lossless) refuseQuality(pattern, "PNGs are lossless");
  makeFolder(pattern_.folder());
  requireWritable(pattern_.path(0));
}

std::string PngSequenceOutput::description() const {
  return fmt::format("PNG {}x{} px{}", format_.width, format_.height, format_.alpha ? ", transparent" : "");
}

std::unique_ptr<ChunkWriter> PngSequenceOutput::begin(const fs::path& file, std::int64_t firstFrame) const {
  return std::make_unique<PngChunkWriter>(file, pattern_, format_, firstFrame);
}

bool PngSequenceOutput::isWhole(const fs::path& file) const {
  if (!isWholeChunk(file)) return false;
  ChunkFileReader reader(file);
  std::vector<std::uint8_t> record;
  while (const std::optional<DoneFrame> done = nextFrame(reader, record)) {
    std::error_code error;
    if (fs::file_size(pattern_.path(done->number), error) != static_cast<std::uintmax_t>(done->bytes) ||
        error)
      return false;
  }
  return true;
}

std::int64_t PngSequenceOutput::join(std::span<const fs::path> chunks, std::int64_t frames) {
  std::int64_t bytes = 0;
  std::vector<std::uint8_t> record;
  frames_ = 0;
  for (const fs::path& chunk : chunks) {
    if (!isWhole(chunk)) // someone has removed or changed a picture meanwhile
      throw Error(ExitCode::Transient, fmt::format("pictures of {} have changed while it was made",
                                                   quoted(pattern_.path(frames_))));
    ChunkFileReader reader(chunk);
    while (const std::optional<DoneFrame> done = nextFrame(reader, record)) {
      bytes += done->bytes;
      ++frames_;
    }
    tellJoined(frames_);
  }
  if (frames_ == 0 || frames_ != frames) {
    throw Error(
        frames == 0 ? ExitCode::BadInput : ExitCode::Transient,
        fmt::format("{} frames to write to {} instead of {}", frames_, quoted(pattern_.path(0)), frames));
  }
  return bytes;
}

std::string PngSequenceOutput::notice() const {
  if (frames_ == 0) return {};
  std::int64_t others = 0;
  std::error_code error;
  for (fs::directory_iterator entry(pattern_.folder(), error), end; !error && entry != end;
       entry.increment(error)) {
    const std::optional<std::int64_t> number = pattern_.numberOf(entry->path().filename().native());
    if (number && *number >= frames_) ++others;
  }
  if (others == 0) return {};
  return fmt::format("{} holds {} frame{} of an earlier run with higher numbers than {}",
                     quoted(pattern_.folder()), others, others == 1 ? "" : "s", frames_ - 1);
}

} // namespace offstage
