#include "render/output/gif_output.h"

#include "render/output/animation_chunk.h"
#include "render/output/atomic_file.h"
#include "render/output/file_error.h"
#include "render/output/gif_palette.h"
#include "render/output/gif_writer.h"
#include "render/output/output_kind.h"
#include "render/output/palette_dither.h"
#include "render/output/picture_limit.h"
#include "render/output/verify_animation.h"
#include "src/sim/error.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr double kMostFps = 50.0;
constexpr std::int64_t kNsPerTick = 10000000; ///< 1/100 s
constexpr std::int64_t kLeastDelay = 2;       ///< ticks
constexpr std::int64_t kMostDelay = 65535;    ///< ticks
constexpr int kMostSide = 65535;

/// A time of a variable rate in ticks, on a grid of the shortest delay.
std::int64_t gridTick(std::int64_t nanoseconds) {
  const std::int64_t step = kLeastDelay * kNsPerTick;
  return (nanoseconds + step / 2) / step * kLeastDelay;
}

/// The clip as palette indices, frame after frame, written as what changes.
class IndexedClip {
public:
  IndexedClip(AtomicFile& file, int width, int height, std::vector<GifColor> palette)
      : width_(width),
        height_(height),
        writer_(file, width, height, palette),
        dither_(std::move(palette)),
        now_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
        before_(now_) {}

  /// Lays a patch over the clip; it is shown from `tick` on.
  void apply(const AnimationPatch& patch, std::span<const std::uint8_t> rows, std::int64_t tick) {
    const auto bytes = static_cast<std::size_t>(patch.rect.right - patch.rect.left) * 4;
    for (int y = patch.rect.top; y < patch.rect.bottom; ++y) {
      dither_.indices(rows.subspan(1, bytes), patch.rect.left, y, &now_[at(patch.rect.left, y)]);
      rows = rows.subspan(1 + bytes); // the filter byte, and the pixels
    }
    const bool first = !frames_ && !pending_;
    const PixelRect rect = first ? PixelRect{0, 0, width_, height_} : changed(patch.rect);
    if (rect.empty()) return; // the frame before simply stays longer
    flush(tick);
    cut(rect, first);
    shownFrom_ = tick;
    pending_ = true;
  }

  /// Ends the clip at `tick`.
  void finish(std::int64_t tick) {
    flush(tick);
    writer_.finish();
  }

  [[nodiscard]] std::int64_t frames() const { return frames_; }
  [[nodiscard]] std::int64_t bytes() const { return writer_.bytesWritten(); }

private:
  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  /// Writes the pending frame: its delay is known now.
  void flush(std::int64_t tick) {
    if (!pending_) return;
    std::int64_t delay = std::max(tick - shownFrom_, kLeastDelay);
    while (true) {
      const std::int64_t part = std::min(delay, kMostDelay - kLeastDelay);
      writer_.add(rect_, indices_, part);
      ++frames_;
      delay -= part;
      if (delay <= 0) break;
      rect_ = kOnePixel; // longer than one frame can be
      indices_.assign(1, GifWriter::kUnchanged);
    }
    pending_ = false;
  }

  /// The smallest rectangle that holds all that changed; outside of `within` nothing did.
  [[nodiscard]] PixelRect changed(const PixelRect& within) const {
    PixelRect rect{width_, height_, 0, 0};
    for (int y = within.top; y < within.bottom; ++y) {
      const auto row = now_.begin() + static_cast<std::ptrdiff_t>(at(0, y));
      const auto then = before_.begin() + static_cast<std::ptrdiff_t>(at(0, y));
      const auto left = std::mismatch(row + within.left, row + within.right, then + within.left).first - row;
      if (left == within.right) continue;
      auto right = static_cast<std::ptrdiff_t>(within.right);
      while (row[right - 1] == then[right - 1]) --right;
      rect = {std::min(rect.left, static_cast<int>(left)), std::min(rect.top, y),
              std::max(rect.right, static_cast<int>(right)), y + 1};
    }
    return rect;
  }

  /// Makes a rectangle the pending frame: its indices, and of what did not change none.
  void cut(const PixelRect& rect, bool whole) {
    rect_ = rect;
    const auto columns = static_cast<std::size_t>(rect.right - rect.left);
    indices_.resize(columns * static_cast<std::size_t>(rect.bottom - rect.top));
    std::uint8_t* to = indices_.data();
    for (int y = rect.top; y < rect.bottom; ++y, to += columns) {
      const std::uint8_t* const row = &now_[at(rect.left, y)];
      std::uint8_t* const then = &before_[at(rect.left, y)];
      for (std::size_t x = 0; x < columns; ++x)
        to[x] = !whole && row[x] == then[x] ? GifWriter::kUnchanged : row[x];
      std::copy_n(row, columns, then);
    }
  }

  int width_;
  int height_;
  GifWriter writer_;
  PaletteDither dither_;
  std::vector<std::uint8_t> now_;    ///< the clip with the last patch
  std::vector<std::uint8_t> before_; ///< with what was cut from it
  bool pending_ = false;
  PixelRect rect_;                    ///< of the pending frame
  std::vector<std::uint8_t> indices_; ///< of the pending frame
  std::int64_t shownFrom_ = 0;        ///< ticks
  std::int64_t frames_ = 0;
};

} // namespace

GifOutput::GifOutput(const std::filesystem::path& path, const SinkFormat& format)
    : path_(path), format_(format) {
  if (format.alpha) refuseTransparency(path, "a .gif");
  if (format.quality) refuseQuality(path, "a .gif has one quality, 255 colours");
  requireCodedSize(path, "a .gif", kMostSide, format.width, format.height);
  if (!(format.fps >= 0.0 && std::isfinite(format.fps)))
    throw Error(ExitCode::BadInput, fmt::format("{}: {} is no rate of frames", quoted(path), format.fps));
  if (format.fps > kMostFps) every_ = static_cast<std::int64_t>(std::ceil(format.fps / kMostFps));
  requireWritable(path_);
}

std::string GifOutput::description() const {
  return fmt::format("GIF {}x{} px, every {}. frame", format_.width, format_.height, every_);
}

std::string GifOutput::notice() const {
  if (every_ == 1) return {};
  return fmt::format("a .gif shows at most 50 frames a second: {:g} of {:g} are kept",
                     format_.fps / static_cast<double>(every_), format_.fps);
}

bool GifOutput::holds(const FrameTiming& timing) const {
  if (format_.fps > 0.0) return timing.index % every_ == 0;
  return gridTick(timing.start) < gridTick(timing.end);
}

std::unique_ptr<ChunkWriter> GifOutput::begin(const std::filesystem::path& file,
                                              std::int64_t firstFrame) const {
  return makeAnimationChunk(file, format_, firstFrame,
                            [this](const FrameTiming& timing) { return holds(timing); });
}

bool GifOutput::isWhole(const std::filesystem::path& file) const {
  return isWholeChunk(file);
}

std::int64_t GifOutput::join(std::span<const std::filesystem::path> chunks, std::int64_t frames) {
  const auto tickOf = [this](std::int64_t frame, std::int64_t nanoseconds) {
    if (format_.fps == 0.0) return gridTick(nanoseconds);
    return static_cast<std::int64_t>(std::llround(static_cast<double>(frame) * 100.0 / format_.fps));
  };
  PatchInflater inflater;
  ColorHistogram histogram;
  AnimationPatch patch;
  std::int64_t end = 0;
  bool any = false;
  for (AnimationReader reader(chunks); reader.next(patch);) {
    const std::span<const std::uint8_t> rows = inflater.rows(patch);
    const std::size_t stride = 1 + static_cast<std::size_t>(patch.rect.right - patch.rect.left) * 4;
    for (std::size_t row = 0; row < rows.size(); row += stride)
      histogram.add(rows.subspan(row + 1, stride - 1));
    end = tickOf(frames, patch.timing.end);
    any = true;
    tellJoined(0);
  }
  if (!any) throw Error(ExitCode::BadInput, fmt::format("no frames to write to {}", quoted(path_)));

  AtomicFile file(path_);
  IndexedClip clip(file, format_.width, format_.height, makePalette(histogram));
  for (AnimationReader reader(chunks); reader.next(patch);) {
    clip.apply(patch, inflater.rows(patch), tickOf(patch.timing.index, patch.timing.start));
    tellJoined(patch.timing.index + 1);
  }
  clip.finish(end);
  verifyAnimation(file.temporary(), {"gif", format_.width, format_.height, clip.frames()}, path_);
  file.commit();
  return clip.bytes();
}

} // namespace offstage
