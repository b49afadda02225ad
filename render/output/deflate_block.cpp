#include "render/output/deflate_block.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <span>

namespace offstage {
namespace {

constexpr unsigned kLongestCode = 15;
constexpr unsigned kLongestLengthCode = 7; // of the codes that describe the codes
constexpr std::size_t kDistanceCodes = 30;
/// The order in which the lengths of the length codes stand (RFC 1951, 3.2.7).
constexpr std::array<std::uint8_t, 19> kLengthCodeOrder{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                        11, 4,  12, 3, 13, 2, 14, 1, 15};
/// Shortest match of each length code, and its extra bits (RFC 1951, 3.2.5).
constexpr std::array<std::uint16_t, 29> kLengthBase{3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                                    15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                                    67, 83, 99, 115, 131, 163, 195, 227, 258};
constexpr std::array<std::uint8_t, 29> kLengthExtra{0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                                    2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};

struct DistanceCode {
  unsigned symbol = 0;
  unsigned extraBits = 0;
  std::uint64_t extra = 0;
};

/// Two codes for every power of two, split by the bit below the highest (RFC 1951, 3.2.5).
DistanceCode distanceCode(std::size_t distance) {
  const std::size_t rest = distance - 1;
  if (rest < 4) return {static_cast<unsigned>(rest), 0, 0};
  const auto highest = static_cast<unsigned>(std::bit_width(rest)) - 1;
  const unsigned extraBits = highest - 1;
  return {static_cast<unsigned>(2 * highest + (rest >> extraBits & 1U)), extraBits,
          rest & ((std::uint64_t{1} << extraBits) - 1)};
}

/// One entry of the compressed list of code lengths.
struct LengthRun {
  std::uint8_t symbol = 0; ///< 0 … 15: that length; 16: the last one again; 17, 18: zeros
  std::uint8_t extraBits = 0;
  std::uint8_t extra = 0;
};

/// The list of code lengths with its repetitions taken together (RFC 1951, 3.2.7).
std::vector<LengthRun> runsOf(std::span<const std::uint8_t> lengths) {
  std::vector<LengthRun> runs;
  for (std::size_t at = 0; at < lengths.size();) {
    std::size_t end = at;
    while (end < lengths.size() && lengths[end] == lengths[at]) ++end;
    if (lengths[at] != 0) runs.push_back({lengths[at++], 0, 0});
    while (end - at >= 3) {
      const std::size_t left = end - at;
      if (lengths[at] != 0) {
        const std::size_t count = std::min<std::size_t>(left, 6);
        runs.push_back({16, 2, static_cast<std::uint8_t>(count - 3)});
        at += count;
      } else if (left <= 10) {
        runs.push_back({17, 3, static_cast<std::uint8_t>(left - 3)});
        at += left;
      } else {
        const std::size_t count = std::min<std::size_t>(left, 138);
        runs.push_back({18, 7, static_cast<std::uint8_t>(count - 11)});
        at += count;
      }
    }
    for (; at < end; ++at) runs.push_back({lengths[at], 0, 0});
  }
  return runs;
}

constexpr auto lengthIndices() {
  std::array<std::uint8_t, DeflateBlock::kLongestMatch + 1> indices{};
  std::uint8_t index = 0;
  for (std::size_t length = DeflateBlock::kShortestMatch; length < indices.size(); ++length) {
    if (index + 1U < kLengthBase.size() && length >= kLengthBase[index + 1U]) ++index;
    indices[length] = index;
  }
  return indices;
}

} // namespace

constinit const std::array<std::uint8_t, DeflateBlock::kLongestMatch + 1> DeflateBlock::kLengthIndex =
    lengthIndices();

DeflateBlock::DeflateBlock(std::size_t near, std::size_t far) : near_(near), far_(far) {
  steps_.reserve(kMostSteps + 1);
}

void DeflateBlock::close() {
  if (literals_ > 0) steps_.push_back({literals_, 0, false});
  literals_ = 0;
  for (const auto& counts : literalCounts_)
    std::ranges::transform(counts, counts_, counts_.begin(), std::plus{});
  counts_[kEndOfBlock] = 1;
  huffmanCodes(counts_, kLongestCode, codes_);
  // With two distances a code of one bit each is the best there is.
  const DistanceCode near = distanceCode(near_);
  const DistanceCode far = far_ == 0 ? DistanceCode{kDistanceCodes, 0, 0} : distanceCode(far_);
  fillTable(near_, near.symbol > far.symbol, matchBits_[0]);
  if (far_ != 0) fillTable(far_, far.symbol > near.symbol, matchBits_[1]);

  bits_ = 3 + 14 + 19 * 3 + (kSymbols + kDistanceCodes) * (kLongestLengthCode + 7);
  for (std::size_t symbol = 0; symbol < kSymbols; ++symbol)
    bits_ += counts_[symbol] * std::size_t{codes_[symbol].length};
  for (std::size_t index = 0; index < kLengthExtra.size(); ++index)
    bits_ += counts_[kFirstLength + index] * std::size_t{kLengthExtra[index]};
  bits_ += matches_[0] * std::size_t{1 + near.extraBits} + matches_[1] * std::size_t{1 + far.extraBits};
}

void DeflateBlock::fillTable(std::size_t distance, std::uint64_t bit, MatchTable& table) const {
  const DistanceCode code = distanceCode(distance);
  for (std::size_t length = kShortestMatch; length <= kLongestMatch; ++length) {
    const std::size_t index = kLengthIndex[length];
    const HuffmanCode& lengthCode = codes_[kFirstLength + index];
    MatchBits& match = table[length];
    match.bits = lengthCode.bits;
    match.count = lengthCode.length;
    const auto append = [&match](std::uint64_t bits, unsigned count) {
      match.bits |= bits << match.count;
      match.count += count;
    };
    append(length - kLengthBase[index], kLengthExtra[index]);
    append(bit, 1);
    append(code.extra, code.extraBits);
  }
}

void DeflateBlock::writeHeader(bool last, BitWriter& out) const {
  std::array<std::uint8_t, kSymbols + kDistanceCodes> lengths{};
  std::size_t symbols = kSymbols;
  while (codes_[symbols - 1].length == 0) --symbols; // the end of the block has one
  for (std::size_t symbol = 0; symbol < symbols; ++symbol) lengths[symbol] = codes_[symbol].length;
  std::size_t distances = 0;
  for (const std::size_t distance : {near_, far_}) {
    if (distance == 0) continue;
    const std::size_t symbol = distanceCode(distance).symbol;
    lengths[symbols + symbol] = 1;
    distances = std::max(distances, symbol + 1);
  }

  const std::vector<LengthRun> runs = runsOf(std::span(lengths).first(symbols + distances));
  std::array<std::uint32_t, kLengthCodeOrder.size()> counts{};
  for (const LengthRun& run : runs) ++counts[run.symbol];
  std::array<HuffmanCode, kLengthCodeOrder.size()> codes{};
  huffmanCodes(counts, kLongestLengthCode, codes);
  std::size_t named = kLengthCodeOrder.size();
  while (named > 4 && codes[kLengthCodeOrder[named - 1]].length == 0) --named;

  out.put(last ? 1 : 0, 1);
  out.put(2, 2); // codes of its own
  out.put(symbols - 257, 5);
  out.put(distances - 1, 5);
  out.put(named - 4, 4);
  for (std::size_t i = 0; i < named; ++i) out.put(codes[kLengthCodeOrder[i]].length, 3);
  for (const LengthRun& run : runs) {
    out.put(codes[run.symbol].bits, codes[run.symbol].length);
    out.put(run.extra, run.extraBits);
  }
}

void DeflateBlock::writeLiterals(const std::uint8_t* from, std::size_t count, BitWriter& out) const {
  std::size_t i = 0;
  for (; i + 3 <= count; i += 3) { // at most 45 bits: one store for three of them
    const HuffmanCode& a = codes_[from[i]];
    const HuffmanCode& b = codes_[from[i + 1]];
    const HuffmanCode& c = codes_[from[i + 2]];
    const unsigned two = static_cast<unsigned>(a.length) + b.length;
    out.put(a.bits | std::uint64_t{b.bits} << a.length | std::uint64_t{c.bits} << two, two + c.length);
  }
  for (; i < count; ++i) out.put(codes_[from[i]].bits, codes_[from[i]].length);
}

const std::uint8_t* DeflateBlock::write(const std::uint8_t* from, bool last, BitWriter& out) {
  writeHeader(last, out);
  for (const Step& step : steps_) {
    writeLiterals(from, step.literals, out);
    from += step.literals + step.length;
    if (step.length == 0) continue;
    const MatchBits& match = matchBits_[step.far][step.length];
    out.put(match.bits, match.count);
  }
  out.put(codes_[kEndOfBlock].bits, codes_[kEndOfBlock].length);
  clear();
  return from;
}

void DeflateBlock::clear() {
  steps_.clear();
  literalCounts_.fill({});
  counts_.fill(0);
  matches_.fill(0);
  literals_ = 0;
}

} // namespace offstage
