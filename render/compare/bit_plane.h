#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace offstage {

/// One bit a pixel. Rows begin at whole words, so that threads may write different rows.
class BitPlane {
public:
  BitPlane() = default;
  BitPlane(int width, int height)
      : words_((static_cast<std::size_t>(width) + 63) / 64),
        bits_(words_ * static_cast<std::size_t>(height), 0) {}

  [[nodiscard]] bool empty() const { return bits_.empty(); } ///< default-made: no pixel has a bit
  [[nodiscard]] std::size_t wordsPerRow() const { return words_; }
  [[nodiscard]] const std::uint64_t* row(int y) const { return &bits_[static_cast<std::size_t>(y) * words_]; }
  std::uint64_t* row(int y) { return &bits_[static_cast<std::size_t>(y) * words_]; }

  [[nodiscard]] bool get(int x, int y) const {
    return !empty() &&
           ((row(y)[static_cast<std::size_t>(x) / 64] >> (static_cast<unsigned>(x) % 64U)) & 1U) != 0;
  }
  void set(int x, int y) {
    row(y)[static_cast<std::size_t>(x) / 64] |= 1ULL << (static_cast<unsigned>(x) % 64U);
  }

  [[nodiscard]] std::int64_t countRow(int y) const {
    std::int64_t count = 0;
    for (std::size_t i = 0; i < words_; ++i) count += std::popcount(row(y)[i]);
    return count;
  }
  [[nodiscard]] std::int64_t count() const {
    std::int64_t count = 0;
    for (const std::uint64_t word : bits_) count += std::popcount(word);
    return count;
  }

  /// Calls f(x) for every set bit of a row, left to right.
  template <class F>
  void forEachInRow(int y, F f) const {
    for (std::size_t i = 0; i < words_; ++i) {
      for (std::uint64_t word = row(y)[i]; word != 0; word &= word - 1)
        f(static_cast<int>(i * 64 + static_cast<std::size_t>(std::countr_zero(word))));
    }
  }

private:
  std::size_t words_ = 0;
  std::vector<std::uint64_t> bits_;
};

} // namespace offstage
