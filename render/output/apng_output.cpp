#include "render/output/apng_output.h"

#include "render/output/animation_chunk.h"
#include "render/output/atomic_file.h"
#include "render/output/byte_order.h"
#include "render/output/file_error.h"
#include "render/output/libav.h"
#include "render/output/output_kind.h"
#include "render/output/picture_limit.h"
#include "render/output/verify_animation.h"
#include "src/sim/error.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <libdeflate.h>

namespace offstage {
namespace {

constexpr int kMostDelayTerm = 65535;
constexpr int kMostSide = std::numeric_limits<std::int32_t>::max(); ///< px
constexpr std::int64_t kNsPerMs = 1000000;

std::int64_t millisecondOf(std::int64_t nanoseconds) {
  return (nanoseconds + kNsPerMs / 2) / kNsPerMs;
}

/// Writes chunks of a PNG file.
class PngChunkStream {
public:
  explicit PngChunkStream(AtomicFile& file) : file_(file) {
    write(std::array<std::uint8_t, 8>{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'});
  }

  void add(const char* type, std::span<const std::uint8_t> head, std::span<const std::uint8_t> data = {}) {
    std::array<std::uint8_t, 8> start{};
    storeBigEndian(start.data(), static_cast<std::uint32_t>(head.size() + data.size()));
    for (std::size_t i = 0; i < 4; ++i) start[4 + i] = static_cast<std::uint8_t>(type[i]);
    write(start);
    write(head);
    write(data);
    // The CRC covers the type and the data, not the length.
    std::uint32_t crc = libdeflate_crc32(0, start.data() + 4, 4);
    crc = libdeflate_crc32(crc, head.data(), head.size());
    if (!data.empty()) crc = libdeflate_crc32(crc, data.data(), data.size());
    std::array<std::uint8_t, 4> end{};
    storeBigEndian(end.data(), crc);
    write(end);
  }

  [[nodiscard]] std::int64_t bytes() const { return bytes_; }

private:
  void write(std::span<const std::uint8_t> bytes) {
    file_.write(bytes.data(), bytes.size());
    bytes_ += static_cast<std::int64_t>(bytes.size());
  }
  AtomicFile& file_;
  std::int64_t bytes_ = 0;
};

/// A text of the file (iTXt, not compressed): keyword, two flags, no language, no translated keyword.
std::vector<std::uint8_t> textChunk(std::string_view keyword, std::string_view text) {
  std::vector<std::uint8_t> data(keyword.begin(), keyword.end());
  data.insert(data.end(), 5, 0);
  data.insert(data.end(), text.begin(), text.end());
  return data;
}

std::uint32_t asUnsigned(int value) {
  return static_cast<std::uint32_t>(value);
}

} // namespace

ApngOutput::ApngOutput(const std::filesystem::path& path, const SinkFormat& format)
    : path_(path), format_(format) {
  if (format.quality && *format.quality != Quality::Lossless) refuseQuality(path, "an .apng is lossless");
  requireCodedSize(path, "an .apng", kMostSide, format.width, format.height);
  if (!(format.fps >= 0.0 && format.fps <= 1000.0))
    throw Error(ExitCode::BadInput,
                fmt::format("{}: an .apng has up to 1000 frames a second, not {}", quoted(path), format.fps));
  const AVRational rate = av_d2q(format.fps, kMostDelayTerm);
  if (format.fps > 0.0 && std::abs(av_q2d(rate) - format.fps) < 1e-9 * format.fps) {
    byIndex_ = true;
    ticksPerSecond_ = rate.num;
    tick_ = rate.den;
  }
  requireWritable(path_);
}

std::string ApngOutput::description() const {
  return fmt::format("APNG {}x{} px, tick {}/{}{}", format_.width, format_.height, tick_, ticksPerSecond_,
                     format_.alpha ? ", transparent" : "");
}

bool ApngOutput::holds(const FrameTiming& timing) const {
  return byIndex_ || millisecondOf(timing.start) < millisecondOf(timing.end);
}

std::unique_ptr<ChunkWriter> ApngOutput::begin(const std::filesystem::path& file,
                                               std::int64_t firstFrame) const {
  return makeAnimationChunk(file, format_, firstFrame,
                            [this](const FrameTiming& timing) { return holds(timing); });
}

bool ApngOutput::isWhole(const std::filesystem::path& file) const {
  return isWholeChunk(file);
}

std::int64_t ApngOutput::join(std::span<const std::filesystem::path> chunks, std::int64_t frames) {
  std::int64_t count = 0;
  AnimationPatch patch;
  for (AnimationReader counter(chunks); counter.next(patch);) ++count;
  if (count == 0 || (byIndex_ && count != frames))
    throw Error(ExitCode::BadInput,
                fmt::format("{} frames to write to {} of {}", count, quoted(path_), frames));

  AtomicFile file(path_);
  PngChunkStream png(file);
  std::array<std::uint8_t, 13> header{};
  storeBigEndian(header.data(), asUnsigned(format_.width));
  storeBigEndian(header.data() + 4, asUnsigned(format_.height));
  header[8] = 8; // bits a sample
  header[9] = 6; // RGBA
  png.add("IHDR", header);
  png.add("sRGB", std::array<std::uint8_t, 1>{0}); // perceptual
  std::array<std::uint8_t, 8> control{};           // how many frames; repeated for ever (0)
  storeBigEndian(control.data(), static_cast<std::uint32_t>(count));
  png.add("acTL", control);

  std::uint32_t sequence = 0;
  AnimationReader reader(chunks);
  for (std::int64_t k = 0; reader.next(patch); ++k) {
    tellJoined(patch.timing.index + 1);
    const std::int64_t ticks =
        byIndex_ ? 1 : millisecondOf(patch.timing.end) - millisecondOf(patch.timing.start);
    // A frame that is too long for thousandths of a second is told in hundredths, tenths or seconds.
    std::int64_t delay = ticks * tick_;
    int perSecond = ticksPerSecond_;
    for (; delay > kMostDelayTerm && perSecond % 10 == 0; perSecond /= 10) delay = (delay + 5) / 10;
    if (delay > kMostDelayTerm) {
      throw Error(ExitCode::BadInput,
                  fmt::format("{}: frame {} lasts {:.1f} s; an .apng's frame lasts at most {} s",
                              quoted(path_), patch.timing.index, static_cast<double>(ticks) / 1000.0,
                              kMostDelayTerm));
    }
    std::array<std::uint8_t, 26> frame{};
    storeBigEndian(frame.data(), sequence++);
    storeBigEndian(frame.data() + 4, asUnsigned(patch.rect.right - patch.rect.left));
    storeBigEndian(frame.data() + 8, asUnsigned(patch.rect.bottom - patch.rect.top));
    storeBigEndian(frame.data() + 12, asUnsigned(patch.rect.left));
    storeBigEndian(frame.data() + 16, asUnsigned(patch.rect.top));
    storeBigEndian16(frame.data() + 20, static_cast<std::uint16_t>(delay));
    storeBigEndian16(frame.data() + 22, static_cast<std::uint16_t>(perSecond));
    frame[24] = 0;                     // the frame stays for the next
    frame[25] = format_.alpha ? 0 : 1; // replaces the pixels, or lies over them
    png.add("fcTL", frame);
    if (k == 0) {
      png.add("IDAT", patch.zlib);
      continue;
    }
    std::array<std::uint8_t, 4> number{};
    storeBigEndian(number.data(), sequence++);
    png.add("fdAT", number, patch.zlib);
  }
  // Behind the frames: libav takes the file for a still picture when a long text stands before them.
  if (!format_.title.empty()) png.add("iTXt", textChunk("Title", format_.title));
  png.add("IEND", {});
  verifyAnimation(file.temporary(), {"apng", format_.width, format_.height, count}, path_);
  file.commit();
  return png.bytes();
}

} // namespace offstage
