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

} // namespace

PixelDeflater::PixelDeflater(std::size_t width, std::size_t channels)
    : channels_(channels),
      rowBytes_(1 + width * channels),
      reachesAbove_(rowBytes_ <= DeflateBlock::kFarthest),
      before_((width - 1) * channels),
      above_(width * channels),
      block_(channels, reachesAbove_ ? rowBytes_ : 0) {}

void PixelDeflater::addMatch(std::size_t length, bool above) {
  // The longest match of all has the shortest code, so that long runs are cut to it, wherever pixels end.
  while (length > 0) {
    std::size_t part = std::min(length, DeflateBlock::kLongestMatch);
    const std::size_t rest = length - part;
    if (rest > 0 && rest < DeflateBlock::kShortestMatch) part -= DeflateBlock::kShortestMatch;
    block_.addMatch(part, above);
    length -= part;
  }
}

template <std::size_t Channels>
void PixelDeflater::addRow(const std::uint8_t* row, bool first) {
  block_.addLiterals(row, 1);
  const std::uint8_t* const pixels = row + 1;
  const std::size_t bytes = rowBytes_ - 1;
  const bool above = reachesAbove_ && !first;
  before_.compare(pixels + Channels, Channels);
  if (above) above_.compare(pixels, rowBytes_);
  // The bytes from `at` on that are to be had as a repetition, in whole pixels.
  const auto asBefore = [&](std::size_t at) {
    return at == 0 ? 0 : before_.run(at - Channels) / Channels * Channels;
  };
  const auto asAbove = [&](std::size_t at) { return above_.run(at) / Channels * Channels; };
  std::size_t at = 0;
  while (at < bytes) {
    const std::size_t run = asBefore(at);
    // A run that is short may end where the row above goes on.
    std::size_t same = above && run < kLongRun ? asAbove(at) : 0;
    if (same < run + kLeastAbove * Channels) same = 0;
    // The runs that follow a pixel which stands for itself are cheaper than one long match.
    if (run == 0 && same >= kLongRun && asBefore(at + Channels) + Channels >= same) same = 0;
    if (same > 0) {
      same = std::min(same, kLongRun); // what then follows is most often a run
      addMatch(same, true);
      at += same;
    } else if (run > 0) {
      addMatch(run, false);
      at += run;
    } else {
      block_.addLiterals(pixels + at, Channels);
      ++literalPixels_;
      at += Channels;
    }
  }
}

std::size_t PixelDeflater::compress(std::span<const std::uint8_t> rows, std::span<std::uint8_t> to) {
  if (to.size() < kZlibHead + kZlibTail + kSlack) return 0;
  to[0] = kZlibMethod;
  to[1] = kZlibFlags;
  const std::size_t count = rows.size() / rowBytes_;
  const std::size_t mostLiterals = rows.size() / channels_ / 4;
  const std::size_t room = to.size() - kZlibTail - kSlack;
  BitWriter out(to.data() + kZlibHead);
  const std::uint8_t* written = rows.data();
  literalPixels_ = 0;
  for (std::size_t y = 0; y < count; ++y) {
    const std::uint8_t* row = rows.data() + y * rowBytes_;
    if (channels_ == 3) {
      addRow<3>(row, y == 0);
    } else {
      addRow<4>(row, y == 0);
    }
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
  storeBigEndian(to.data() + size, libdeflate_adler32(1, rows.data(), rows.size()));
  return size + kZlibTail;
}

} // namespace offstage
