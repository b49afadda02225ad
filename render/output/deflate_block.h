#pragma once

#include "render/output/bit_writer.h"
#include "render/output/huffman.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace offstage {

/// A block of a deflate stream (RFC 1951, 3.2.7: with codes of its own) whose matches reach back by one of
/// two distances. It is filled, closed, written, and used again.
class DeflateBlock {
public:
  static constexpr std::size_t kShortestMatch = 3;
  static constexpr std::size_t kLongestMatch = 258;
  static constexpr std::size_t kFarthest = 32768;

  /// Distances in bytes, 1 … kFarthest, not equal; 0 for a second one that no match will have.
  DeflateBlock(std::size_t near, std::size_t far);

  /// `count` bytes that stand for themselves. Which they are is told by countLiterals(), before or after.
  void addLiterals(std::size_t count) { literals_ += static_cast<std::uint32_t>(count); }
  /// `Count` (1 … 4) such bytes.
  template <std::size_t Count>
  void countLiterals(const std::uint8_t* bytes) {
    // The channels of a pixel are often the same byte. Counted in one place, each would wait for the one
    // before.
    for (std::size_t i = 0; i < Count; ++i) ++literalCounts_[i][bytes[i]];
  }
  /// `length` bytes (kShortestMatch … kLongestMatch) that repeat those one distance before.
  void addMatch(std::size_t length, bool far) {
    ++counts_[kFirstLength + kLengthIndex[length]];
    ++matches_[far];
    steps_.push_back({literals_, static_cast<std::uint16_t>(length), far});
    literals_ = 0;
  }
  /// Enough for its codes to fit what it holds; going on would only need more memory.
  [[nodiscard]] bool full() const { return steps_.size() >= kMostSteps; }

  /// Chooses the codes. Nothing may be added any more until it has been written.
  void close();
  /// Of a closed block, at most.
  [[nodiscard]] std::size_t bits() const { return bits_; }
  /// Writes a closed block and empties it. `from` is where the bytes stand that were added, in the order in
  /// which they were. Returns where they end.
  const std::uint8_t* write(const std::uint8_t* from, bool last, BitWriter& out);
  /// Forgets what was added.
  void clear();

private:
  static constexpr std::size_t kMostSteps = std::size_t{1} << 16U;
  static constexpr std::size_t kEndOfBlock = 256;
  static constexpr std::size_t kFirstLength = 257;
  static constexpr std::size_t kSymbols = 286;
  static constexpr std::size_t kCounters = 4;
  /// The code of each length, counted from kFirstLength.
  static const std::array<std::uint8_t, kLongestMatch + 1> kLengthIndex;

  struct Step {
    std::uint32_t literals = 0;
    std::uint16_t length = 0;
    bool far = false;
  };
  /// What a match is written as: its length's code and extra bits, its distance's code and extra bits.
  struct MatchBits {
    std::uint64_t bits = 0;
    unsigned count = 0;
  };
  using MatchTable = std::array<MatchBits, kLongestMatch + 1>;

  void fillTable(std::size_t distance, std::uint64_t distanceCode, MatchTable& table) const;
  void writeHeader(bool last, BitWriter& out) const;
  void writeLiterals(const std::uint8_t* from, std::size_t count, BitWriter& out) const;

  std::size_t near_;
  std::size_t far_;
  std::vector<Step> steps_;
  std::uint32_t literals_ = 0; ///< since the last match
  std::array<std::array<std::uint32_t, kEndOfBlock>, kCounters> literalCounts_{};
  std::array<std::uint32_t, kSymbols> counts_{}; ///< of matches; of literals from close() on
  std::array<std::uint32_t, 2> matches_{};       ///< near, far
  std::array<HuffmanCode, kSymbols> codes_{};
  std::array<MatchTable, 2> matchBits_{}; ///< near, far
  std::size_t bits_ = 0;
};

} // namespace offstage
