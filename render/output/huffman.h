#pragma once

#include <cstdint>
#include <span>

namespace offstage {

/// A symbol's code: its bits reversed, so that the first is the lowest, as deflate packs them.
struct HuffmanCode {
  std::uint16_t bits = 0;
  std::uint8_t length = 0; ///< bits; 0: the symbol has no code
};

/// The prefix code of least total length for symbols that occur `counts` times, none longer than `longest`
/// bits, and canonical as deflate wants it (RFC 1951, 3.2.2). Symbols that do not occur have no code; a
/// single one that does has a code of one bit. codes.size() = counts.size() ≤ 320, of which at most 2^longest
/// occur; the sum of counts is below 2^32. Where the limit bites, the code is near the best rather than the
/// best.
void huffmanCodes(std::span<const std::uint32_t> counts, unsigned longest, std::span<HuffmanCode> codes);

} // namespace offstage
