#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace offstage {

static_assert(std::endian::native == std::endian::little, "BitWriter stores whole words");

/// Writes bits as deflate packs them, the lowest bit of each byte first (RFC 1951, 3.1.1).
class BitWriter {
public:
  /// Behind what it writes, 8 bytes of the buffer may be overwritten.
  explicit BitWriter(std::uint8_t* to) : begin_(to), at_(to) {}

  /// The lowest `count` bits of `bits`, 0 … 56; the others must be 0.
  void put(std::uint64_t bits, unsigned count) {
    pending_ |= bits << pendingBits_;
    pendingBits_ += count;
    std::memcpy(at_, &pending_, sizeof pending_);
    at_ += pendingBits_ >> 3U;
    pending_ >>= pendingBits_ & ~7U;
    pendingBits_ &= 7U;
  }

  /// Whole bytes so far.
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(at_ - begin_); }

  /// Fills the last byte up with zeros. Returns the bytes written.
  std::size_t finish() {
    if (pendingBits_ > 0) put(0, 8 - pendingBits_);
    return size();
  }

private:
  std::uint8_t* begin_;
  std::uint8_t* at_;
  std::uint64_t pending_ = 0;
  unsigned pendingBits_ = 0; ///< 0 … 7 between calls
};

} // namespace offstage
