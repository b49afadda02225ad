#include "render/output/huffman.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace offstage {
namespace {

constexpr std::size_t kMostSymbols = 320;
constexpr std::size_t kMostBits =
    64; // no tree of counts below 2^32 in sum is deeper than 46 (Fibonacci numbers)

/// Depths in the Huffman tree of leaves with these weights, ascending; the result descends. After A. Moffat
/// and J. Katajainen, "In-place calculation of minimum-redundancy codes" (1995), though with arrays of its
/// own: the leaves and the inner nodes, both in order of weight, are two queues.
void treeDepths(std::span<const std::uint32_t> weights, std::span<std::uint8_t> depths) {
  const std::size_t leaves = weights.size();
  std::array<std::uint32_t, kMostSymbols> inner{};
  std::array<std::size_t, kMostSymbols> leafParent{};
  std::array<std::size_t, kMostSymbols> innerParent{};
  std::size_t leaf = 0;
  std::size_t node = 0;
  for (std::size_t made = 0; made + 1 < leaves; ++made) {
    for (int child = 0; child < 2; ++child) {
      if (leaf < leaves && (node >= made || weights[leaf] <= inner[node])) {
        inner[made] += weights[leaf];
        leafParent[leaf++] = made;
      } else {
        inner[made] += inner[node];
        innerParent[node++] = made;
      }
    }
  }
  std::array<std::uint8_t, kMostSymbols> innerDepth{};
  for (std::size_t i = leaves - 1; i-- > 0;)
    innerDepth[i] =
        i + 2 == leaves ? std::uint8_t{0} : static_cast<std::uint8_t>(innerDepth[innerParent[i]] + 1);
  for (std::size_t i = 0; i < leaves; ++i)
    depths[i] = static_cast<std::uint8_t>(innerDepth[leafParent[i]] + 1);
}

/// Makes a complete code of `ofLength` (how many symbols have which length) that keeps to the limit: what is
/// too long is cut to it, and for the room that this takes shorter codes are lengthened, the longest of them
/// first.
void limitLengths(std::array<std::uint32_t, kMostBits>& ofLength, unsigned longest) {
  std::uint64_t room = 0; // in units of 2^-longest
  for (std::size_t bits = longest + 1; bits < kMostBits; ++bits) {
    ofLength[longest] += ofLength[bits];
    ofLength[bits] = 0;
  }
  for (unsigned bits = 1; bits <= longest; ++bits) room += std::uint64_t{ofLength[bits]} << (longest - bits);
  while (room > std::uint64_t{1} << longest) {
    // One code of the limit's length becomes the sibling of a shorter one, which moves a bit down.
    unsigned bits = longest - 1;
    while (ofLength[bits] == 0) --bits;
    --ofLength[bits];
    ofLength[bits + 1] += 2;
    --ofLength[longest];
    --room;
  }
}

std::uint16_t reversed(unsigned code, unsigned length) {
  unsigned result = 0;
  for (unsigned bit = 0; bit < length; ++bit) result |= (code >> bit & 1U) << (length - 1 - bit);
  return static_cast<std::uint16_t>(result);
}

} // namespace

void huffmanCodes(std::span<const std::uint32_t> counts, unsigned longest, std::span<HuffmanCode> codes) {
  std::fill(codes.begin(), codes.end(), HuffmanCode{});
  std::array<std::uint16_t, kMostSymbols> order{};
  std::size_t used = 0;
  for (std::size_t symbol = 0; symbol < counts.size(); ++symbol) {
    if (counts[symbol] > 0) order[used++] = static_cast<std::uint16_t>(symbol);
  }
  if (used == 0) return;
  std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(used),
            [&](std::uint16_t a, std::uint16_t b) {
              return counts[a] != counts[b] ? counts[a] < counts[b] : a < b;
            });
  std::array<std::uint32_t, kMostSymbols> weights{};
  for (std::size_t i = 0; i < used; ++i) weights[i] = counts[order[i]];
  std::array<std::uint8_t, kMostSymbols> depths{};
  if (used == 1) {
    depths[0] = 1;
  } else {
    treeDepths(std::span(weights).first(used), std::span(depths).first(used));
  }

  std::array<std::uint32_t, kMostBits> ofLength{};
  for (std::size_t i = 0; i < used; ++i) ++ofLength[depths[i]];
  limitLengths(ofLength, longest);
  std::size_t next = 0; // the rarest symbols have the longest codes
  for (unsigned bits = longest; bits > 0; --bits) {
    for (std::uint32_t i = 0; i < ofLength[bits]; ++i)
      codes[order[next++]].length = static_cast<std::uint8_t>(bits);
  }

  std::array<unsigned, kMostBits> nextCode{};
  unsigned code = 0;
  for (unsigned bits = 1; bits <= longest; ++bits) {
    code <<= 1U;
    nextCode[bits] = code;
    code += ofLength[bits];
  }
  for (HuffmanCode& entry : codes) {
    if (entry.length > 0) entry.bits = reversed(nextCode[entry.length]++, entry.length);
  }
}

} // namespace offstage
