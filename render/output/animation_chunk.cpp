#include "render/output/animation_chunk.h"

#include "render/output/byte_order.h"
#include "render/output/frame_check.h"
#include "src/sim/error.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <utility>

#include <libdeflate.h>

namespace offstage {
namespace {

/// As for PNGs, but a patch holds little else than what changed, so the time matters less than the size.
constexpr int kLevel = 6;
constexpr std::size_t kHead = 3 * sizeof(std::int64_t) + 4 * sizeof(std::int32_t);

std::size_t rowBytes(const PixelRect& rect) {
  return 1 + static_cast<std::size_t>(rect.right - rect.left) * 4;
}

std::size_t heightOf(const PixelRect& rect) {
  return static_cast<std::size_t>(rect.bottom - rect.top);
}

class AnimationChunkWriter : public ChunkWriter {
public:
  AnimationChunkWriter(const std::filesystem::path& file, const SinkFormat& format, std::int64_t firstFrame,
                       std::function<bool(const FrameTiming&)> keeps)
      : format_(format),
        keeps_(std::move(keeps)),
        order_(firstFrame, format.fps == 0.0),
        file_(file),
        compressor_(libdeflate_alloc_compressor(kLevel), libdeflate_free_compressor) {
    if (!compressor_) throw std::bad_alloc();
  }

  void write(const Frame& frame, const FrameTiming& timing) override {
    requireFrameSize(frame, format_.width, format_.height);
    order_.require(timing);
    if (!keeps_(timing)) return;
    const bool first = before_.empty();
    const PixelRect rect = first ? PixelRect{0, 0, format_.width, format_.height} : changed(frame);
    fillRows(frame, rect, first);
    put(timing, rect);
    before_ = frame.rgba;
  }

  void skip(const FrameTiming& timing) override { order_.require(timing); }

  void finish() override { file_.commit(); }
  [[nodiscard]] std::int64_t bytesWritten() const override { return file_.bytesWritten(); }

private:
  [[nodiscard]] const std::uint8_t* pixel(const std::vector<std::uint8_t>& rgba, int row, int column) const {
    return rgba.data() + (static_cast<std::size_t>(row) * static_cast<std::size_t>(format_.width) +
                          static_cast<std::size_t>(column)) *
                             4;
  }

  /// The smallest rectangle outside of which the frame equals the one before.
  [[nodiscard]] PixelRect changed(const Frame& frame) const {
    PixelRect rect{format_.width, format_.height, 0, 0};
    const auto stride = static_cast<std::size_t>(format_.width) * 4;
    for (int row = 0; row < format_.height; ++row) {
      const std::uint8_t* now = pixel(frame.rgba, row, 0);
      const std::uint8_t* then = pixel(before_, row, 0);
      if (std::memcmp(now, then, stride) == 0) continue;
      rect.top = std::min(rect.top, row);
      rect.bottom = row + 1;
      int left = 0;
      while (std::memcmp(now + 4 * left, then + 4 * left, 4) == 0) ++left;
      int right = format_.width;
      while (std::memcmp(now + 4 * (right - 1), then + 4 * (right - 1), 4) == 0) --right;
      rect.left = std::min(rect.left, left);
      rect.right = std::max(rect.right, right);
    }
    return rect.empty() ? kOnePixel : rect;
  }

  void fillRows(const Frame& frame, const PixelRect& rect, bool first) {
    const auto pixels = static_cast<std::size_t>(rect.right - rect.left);
    rows_.resize(heightOf(rect) * rowBytes(rect));
    std::uint8_t* to = rows_.data();
    for (int row = rect.top; row < rect.bottom; ++row) {
      *to++ = 0;
      const std::uint8_t* now = pixel(frame.rgba, row, rect.left);
      std::memcpy(to, now, pixels * 4);
      if (!first && !format_.alpha) {
        const std::uint8_t* then = pixel(before_, row, rect.left);
        for (std::size_t x = 0; x < pixels; ++x)
          if (std::memcmp(now + 4 * x, then + 4 * x, 4) == 0) std::memset(to + 4 * x, 0, 4);
      }
      to += pixels * 4;
    }
  }

  void put(const FrameTiming& timing, const PixelRect& rect) {
    record_.clear();
    const auto append = [this](auto value) {
      const auto bytes = littleEndian(value);
      record_.insert(record_.end(), bytes.begin(), bytes.end());
    };
    for (const std::int64_t value : {timing.index, timing.start, timing.end}) append(value);
    for (const std::int32_t value : {rect.left, rect.top, rect.right, rect.bottom}) append(value);
    const std::size_t bound = libdeflate_zlib_compress_bound(compressor_.get(), rows_.size());
    record_.resize(kHead + bound);
    record_.resize(kHead + libdeflate_zlib_compress(compressor_.get(), rows_.data(), rows_.size(),
                                                    record_.data() + kHead, bound));
    file_.add(record_);
  }

  const SinkFormat& format_;
  std::function<bool(const FrameTiming&)> keeps_;
  FrameOrder order_;
  ChunkFileWriter file_;
  std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor_;
  std::vector<std::uint8_t> before_; ///< pixels of the frame kept before; empty at first
  std::vector<std::uint8_t> rows_;
  std::vector<std::uint8_t> record_;
};

} // namespace

std::unique_ptr<ChunkWriter> makeAnimationChunk(const std::filesystem::path& file, const SinkFormat& format,
                                                std::int64_t firstFrame,
                                                std::function<bool(const FrameTiming&)> keeps) {
  return std::make_unique<AnimationChunkWriter>(file, format, firstFrame, std::move(keeps));
}

bool AnimationReader::next(AnimationPatch& patch) {
  while (true) {
    if (!reader_) {
      if (nextChunk_ == chunks_.size()) return false;
      reader_ = std::make_unique<ChunkFileReader>(chunks_[nextChunk_++]);
    }
    if (reader_->next(record_)) break;
    reader_.reset();
  }
  if (record_.size() < kHead) throw Error(ExitCode::Transient, "a chunk holds a damaged frame");
  const std::span<const std::uint8_t> bytes(record_);
  patch.timing = {fromLittleEndian<std::int64_t>(bytes), fromLittleEndian<std::int64_t>(bytes.subspan(8)),
                  fromLittleEndian<std::int64_t>(bytes.subspan(16))};
  patch.rect = {
      fromLittleEndian<std::int32_t>(bytes.subspan(24)), fromLittleEndian<std::int32_t>(bytes.subspan(28)),
      fromLittleEndian<std::int32_t>(bytes.subspan(32)), fromLittleEndian<std::int32_t>(bytes.subspan(36))};
  patch.zlib.assign(record_.begin() + kHead, record_.end());
  return true;
}

struct PatchInflater::Decompressor {
  libdeflate_decompressor* handle = libdeflate_alloc_decompressor();
  Decompressor() {
    if (handle == nullptr) throw std::bad_alloc();
  }
  ~Decompressor() { libdeflate_free_decompressor(handle); }
  Decompressor(const Decompressor&) = delete;
  Decompressor& operator=(const Decompressor&) = delete;
};

PatchInflater::PatchInflater() : decompressor_(std::make_unique<Decompressor>()) {}
PatchInflater::~PatchInflater() = default;

std::span<const std::uint8_t> PatchInflater::rows(const AnimationPatch& patch) {
  rows_.resize(heightOf(patch.rect) * rowBytes(patch.rect));
  if (libdeflate_zlib_decompress(decompressor_->handle, patch.zlib.data(), patch.zlib.size(), rows_.data(),
                                 rows_.size(), nullptr) != LIBDEFLATE_SUCCESS)
    throw Error(ExitCode::Transient, "a chunk holds a damaged frame");
  return rows_;
}

} // namespace offstage
