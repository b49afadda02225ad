#pragma once

#include "render/output/wide.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace offstage {

/// Which bytes of a row are the same as those a fixed distance before them, one bit a byte.
class RepeatMask {
public:
  /// For rows of `bytes` bytes.
  explicit RepeatMask(std::size_t bytes, bool wide = processorIsWide())
      : bytes_(bytes), wide_(wide), words_(bytes / kBits + 2) {}

  /// Compares the row at `row`; `distance` bytes before it can be read too.
  void compare(const std::uint8_t* row, std::size_t distance);

  /// How many bytes from `at` (0 … bytes) on repeat without a gap.
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
  std::size_t bytes_;
  bool wide_;
  std::vector<std::uint64_t> words_;
};

} // namespace offstage
