#include "render/output/pixel_deflate.h"

#include "render/output/byte_order.h"

#include <algorithm>

#include <libdeflate.h>

namespace offstage {
namespace {

// 32 KiB of window, the fastest compressor's mark, and the check bits that make it divisible by 31.
constexpr std::uint8_t kZlibMethod = 0x78;
constexpr std::uint8_t kZlibFlags = 0x01;
constexpr std::size_t kZlibHead = 2;
constexpr std::size_t kZlibTail = 4;
constexpr std::size_t kSlack = 8; // BitWriter's
/// A match with the row above costs some 13 bits: more than one more run of the pixel before, less than two
/// pixels that stand for themselves.
constexpr std::size_t kLeastAbove = 2;
/// Bytes of about the longest match, in whole pixels of 3 or 4 bytes.
constexpr std::size_t kLongRun = 252;
constexpr std::size_t kRgbaBytes = 4;

} // namespace

PixelDeflater::PixelDeflater(std::size_t width, std::size_t channels)
    : width_(width),
      channels_(channels),
      rowBytes_(1 + width * channels),
      reachesAbove_(rowBytes_ <= DeflateBlock::kFarthest),
      before_(width, channels == kRgbaBytes),
      above_(width, channels == kRgbaBytes),
      literals_(width, channels == kRgbaBytes),
      block_(channels, reachesAbove_ ? rowBytes_ : 0) {}

void PixelDeflater::addMatch(std::size_t length, bool above) {
  // The longest match of all has the shortest code, so that long runs are cut to it, wherever pixels end.
  while (length > DeflateBlock::kLongestMatch) {
    const std::size_t rest = length - DeflateBlock::kLongestMatch;
    const std::size_t part = DeflateBlock::kLongestMatch -
                             (rest < DeflateBlock::kShortestMatch ? DeflateBlock::kShortestMatch : 0);
    block_.addMatch(part, above);
    length -= part;
  }
  block_.addMatch(length, above);
}

template <std::size_t Channels>
void PixelDeflater::addRow(const std::uint8_t* row, const std::uint8_t* rgba, bool above) {
  constexpr std::size_t kLong = kLongRun / Channels;
  block_.addLiterals(1);
  block_.countLiterals<1>(row);
  before_.compareWithPrevious(rgba);
  if (above) {
    above_.compare(rgba, rgba - width_ * kRgbaBytes);
  } else {
    above_.clear();
  }
  literals_.setLiterals(before_, above_);
  std::size_t at = 0;
  while (at < width_) {
    if (const std::size_t count = literals_.run(at); count > 0) {
      block_.addLiterals(count * Channels);
      at += count;
      continue;
    }
    const std::size_t run = before_.run(at);
    // A run that is short may end where the row above goes on.
    std::size_t same = run < kLong ? above_.run(at) : 0;
    if (same < run + kLeastAbove) same = 0;
    // The runs that follow a pixel which stands for itself are cheaper than one long match.
    if (run == 0 && same >= kLong && before_.run(at + 1) + 1 >= same) same = 0;
    if (same > 0) {
      same = std::min(same, kLong); // what then follows is most often a run
      addMatch(same * Channels, true);
      at += same;
      literals_.set(at - 1, false); // it looked like one, since nothing is repeated behind it
    } else if (run > 0) {
      addMatch(run * Channels, false);
      at += run;
    } else {
      block_.addLiterals(Channels);
      literals_.set(at, true);
      ++at;
    }
  }
  // All of a row's at once: run by run, the processor would guess the end of every run wrong.
  const std::uint8_t* const pixels = row + 1;
  literals_.forEach([&](std::size_t pixel) {
    block_.countLiterals<Channels>(pixels + pixel * Channels);
    ++literalPixels_;
  });
}

std::size_t PixelDeflater::compress(std::span<const std::uint8_t> rows, const std::uint8_t* rgba,
                                    const std::function<void(std::size_t row)>& prepare,
                                    std::span<std::uint8_t> to) {
  if (to.size() < kZlibHead + kZlibTail + kSlack) return 0;
  to[0] = kZlibMethod;
  to[1] = kZlibFlags;
  const std::size_t count = rows.size() / rowBytes_;
  const std::size_t mostLiterals = rows.size() / channels_ / 4;
  const std::size_t room = to.size() - kZlibTail - kSlack;
  BitWriter out(to.data() + kZlibHead);
  const std::uint8_t* written = rows.data();
  literalPixels_ = 0;
  std::uint32_t checksum = libdeflate_adler32(0, nullptr, 0);
  for (std::size_t y = 0; y < count; ++y) {
    prepare(y);
    const std::uint8_t* row = rows.data() + y * rowBytes_;
    const std::uint8_t* const pixels = rgba + y * width_ * kRgbaBytes;
    const bool above = reachesAbove_ && y > 0;
    if (channels_ == 3) {
      addRow<3>(row, pixels, above);
    } else {
      addRow<4>(row, pixels, above);
    }
    checksum = libdeflate_adler32(checksum, row, rowBytes_);
    const bool last = y + 1 == count;
    if (!last && !block_.full()) continue;
    block_.close();
    const bool fits = kZlibHead + out.size() + block_.bits() / 8 + 1 <= room;
    if (literalPixels_ > mostLiterals || !fits) {
      block_.clear();
      return 0;
    }
    written = block_.write(written, last, out);
  }
  const std::size_t size = kZlibHead + out.finish();
  storeBigEndian(to.data() + size, checksum);
  return size + kZlibTail;
}

} // namespace offstage
