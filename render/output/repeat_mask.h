#pragma once

#include "src/sim/processor.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// Something that holds or does not for each pixel of a row, one bit a pixel.
class RepeatMask {
public:
  /// For rows of `pixels` RGBA pixels (≥ 1), for none of which it holds yet. `alpha`: whether pixels that
  /// differ in alpha alone differ.
  RepeatMask(std::size_t pixels, bool alpha, bool wide = processorIsWide())
      : pixels_(pixels),
        compared_(alpha ? 0xFFFFFFFFU : 0x00FFFFFFU),
        wide_(wide),
        words_(pixels / kBits + 2) {}

  /// Which pixels of `row` are those at the same places of `other`.
  void compare(const std::uint8_t* row, const std::uint8_t* other);
  /// Which pixels of `row` are as the one before them; never the first.
  void compareWithPrevious(const std::uint8_t* row);
  /// None.
  void clear();
  /// Where `before` does not hold, and `above` not for two pixels from there on. All of one size.
  void setLiterals(const RepeatMask& before, const RepeatMask& above);

  void set(std::size_t at, bool holds) {
    const std::uint64_t bit = std::uint64_t{1} << at % kBits;
    std::uint64_t& word = words_[at / kBits];
    word = holds ? word | bit : word & ~bit;
  }

  /// Calls `visit` with every pixel for which it holds, from left to right.
  template <typename Visit>
  void forEach(Visit visit) const {
    for (std::size_t word = 0; word < words_.size(); ++word)
      for (std::uint64_t left = words_[word]; left != 0; left &= left - 1)
        visit(word * kBits + static_cast<std::size_t>(std::countr_zero(left)));
  }

  /// For how many pixels from `at` (0 … pixels) on it holds without a gap.
  [[nodiscard]] std::size_t run(std::size_t at) const {
    std::size_t word = at / kBits;
    const std::size_t inWord = at % kBits;
    std::size_t length = static_cast<std::size_t>(std::countr_one(words_[word] >> inWord));
    if (length < kBits - inWord) return length;
    int ones = 0;
    do {
      ones = std::countr_one(words_[++word]); // the last word is 0
      length += static_cast<std::size_t>(ones);
    } while (static_cast<std::size_t>(ones) == kBits);
    return length;
  }

private:
  static constexpr std::size_t kBits = 64;
  /// A word for every 64 pixels.
  void compareWords(const std::uint8_t* row, const std::uint8_t* other, std::span<std::uint64_t> words) const;
  /// compare() from the pixel `from` on, a multiple of kBits.
  void compareFrom(std::size_t from, const std::uint8_t* row, const std::uint8_t* other);

  std::size_t pixels_;
  std::uint32_t compared_; ///< bits of a pixel, the red ones lowest
  bool wide_;
  std::vector<std::uint64_t> words_; ///< the bits behind the last pixel are 0
};

} // namespace offstage
