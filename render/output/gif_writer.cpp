#include "render/output/gif_writer.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace offstage {
namespace {

constexpr int kIndexBits = 8;
constexpr int kClear = 1 << kIndexBits;
constexpr int kEnd = kClear + 1;
constexpr int kMostCodeBits = 12;
constexpr int kMostCodes = 1 << kMostCodeBits;
constexpr std::size_t kMostBlock = 255;

// A string is a code and the index that follows it, 20 bits, and a slot of the table holds them above the
// code of that longer string, which is never 0. The table stays in the processor's nearest cache, and half of
// it empty.
constexpr std::size_t kSlots = 8192;
constexpr std::uint32_t kCodeMask = kMostCodes - 1;

std::size_t slotOf(std::uint32_t string) {
  // Multiplicative hashing by 2^32 over the golden ratio (D. Knuth, The Art of Computer Programming 3, 6.4).
  return (string * 2654435769U) >> 19U;
}

void append16(std::vector<std::uint8_t>& bytes, int value) {
  bytes.push_back(static_cast<std::uint8_t>(value));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
}

/// Codes of growing length, lowest bit first.
class BitWriter {
public:
  void add(int code, int bits) {
    pending_ |= static_cast<std::uint32_t>(code) << count_;
    for (count_ += bits; count_ >= 8; count_ -= 8, pending_ >>= 8U)
      bytes_.push_back(static_cast<std::uint8_t>(pending_));
  }
  std::vector<std::uint8_t>& finish() {
    if (count_ > 0) bytes_.push_back(static_cast<std::uint8_t>(pending_));
    return bytes_;
  }

private:
  std::vector<std::uint8_t> bytes_;
  std::uint32_t pending_ = 0;
  int count_ = 0;
};

} // namespace

GifWriter::GifWriter(AtomicFile& file, int width, int height, const std::vector<GifColor>& palette)
    : file_(file), longer_(kSlots) {
  std::vector<std::uint8_t> head{'G', 'I', 'F', '8', '9', 'a'};
  append16(head, width);
  append16(head, height);
  head.insert(head.end(), {0xF7, 0, 0}); // a palette of 256 colours of 8 bits; background 0; square pixels
  for (std::size_t i = 0; i < 256; ++i) {
    const GifColor color = i < palette.size() ? palette[i] : GifColor{};
    head.insert(head.end(), color.begin(), color.end());
  }
  constexpr std::string_view kRepeat = "\x21\xFF\x0BNETSCAPE2.0\x03\x01";
  head.insert(head.end(), kRepeat.begin(), kRepeat.end());
  head.insert(head.end(), {0, 0, 0}); // for ever
  put(head);
}

void GifWriter::put(std::span<const std::uint8_t> bytes) {
  file_.write(bytes.data(), bytes.size());
  bytes_ += static_cast<std::int64_t>(bytes.size());
}

void GifWriter::add(const PixelRect& rect, std::span<const std::uint8_t> indices, std::int64_t delay) {
  std::vector<std::uint8_t> head{0x21, 0xF9, 4,
                                 0x05}; // the frame stays for the next; an index is transparent
  append16(head, static_cast<int>(delay));
  head.insert(head.end(), {kUnchanged, 0, 0x2C});
  for (const int value : {rect.left, rect.top, rect.right - rect.left, rect.bottom - rect.top})
    append16(head, value);
  head.insert(head.end(), {0, kIndexBits}); // no palette of its own, not interlaced
  put(head);
  putCompressed(indices);
}

/// LZW: the longest strings seen so far are written as codes (T. Welch, A technique for high-performance data
/// compression, Computer 17 (6), 1984).
void GifWriter::putCompressed(std::span<const std::uint8_t> indices) {
  BitWriter bits;
  int codeBits = kIndexBits + 1;
  int next = kEnd + 1;
  const auto clear = [&] {
    bits.add(kClear, codeBits);
    std::ranges::fill(longer_, 0U);
    codeBits = kIndexBits + 1;
    next = kEnd + 1;
  };
  clear();
  int code = indices.front();
  for (const std::uint8_t index : indices.subspan(1)) {
    const std::uint32_t string = static_cast<std::uint32_t>(code) << kIndexBits | index;
    std::size_t slot = slotOf(string);
    while (longer_[slot] != 0 && longer_[slot] >> kMostCodeBits != string) slot = (slot + 1) % kSlots;
    if (longer_[slot] != 0) {
      code = static_cast<int>(longer_[slot] & kCodeMask);
      continue;
    }
    bits.add(code, codeBits);
    if (next == kMostCodes) {
      clear();
    } else {
      if (next == 1 << codeBits) ++codeBits; // the reader knows the new code only now
      longer_[slot] = string << kMostCodeBits | static_cast<std::uint32_t>(next++);
    }
    code = index;
  }
  bits.add(code, codeBits);
  if (next == 1 << codeBits && codeBits < kMostCodeBits) ++codeBits;
  bits.add(kEnd, codeBits);

  const std::vector<std::uint8_t>& bytes = bits.finish();
  for (std::size_t at = 0; at < bytes.size(); at += kMostBlock) {
    const std::size_t size = std::min(kMostBlock, bytes.size() - at);
    put(std::array<std::uint8_t, 1>{static_cast<std::uint8_t>(size)});
    put(std::span(bytes).subspan(at, size));
  }
  put(std::array<std::uint8_t, 1>{0});
}

void GifWriter::finish() {
  put(std::array<std::uint8_t, 1>{0x3B});
}

} // namespace offstage
