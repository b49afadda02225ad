#include "render/output/huffman.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <queue>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace offstage {
namespace {

/// Bits that the best prefix code without a limit needs: the sum of a Huffman tree's inner nodes.
std::uint64_t bestTotal(const std::vector<std::uint32_t>& counts) {
  std::priority_queue<std::uint64_t, std::vector<std::uint64_t>, std::greater<>> weights;
  for (const std::uint32_t count : counts) {
    if (count > 0) weights.push(count);
  }
  if (weights.size() == 1) return weights.top();
  std::uint64_t total = 0;
  while (weights.size() > 1) {
    std::uint64_t sum = weights.top();
    weights.pop();
    sum += weights.top();
    weights.pop();
    total += sum;
    weights.push(sum);
  }
  return total;
}

struct Measured {
  std::uint64_t total = 0; ///< bits of all symbols
  double kraft = 0.0;      ///< sum of 2^-length: 1 when the code is complete
  unsigned longest = 0;
};

Measured measure(const std::vector<std::uint32_t>& counts, const std::vector<HuffmanCode>& codes) {
  Measured measured;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    EXPECT_EQ(codes[i].length > 0, counts[i] > 0) << "symbol " << i;
    measured.total += std::uint64_t{counts[i]} * codes[i].length;
    if (codes[i].length > 0) measured.kraft += 1.0 / static_cast<double>(1U << codes[i].length);
    measured.longest = std::max<unsigned>(measured.longest, codes[i].length);
  }
  return measured;
}

std::vector<HuffmanCode> codesOf(const std::vector<std::uint32_t>& counts, unsigned longest) {
  std::vector<HuffmanCode> codes(counts.size());
  huffmanCodes(counts, longest, codes);
  return codes;
}

std::vector<std::uint32_t> randomCounts(std::mt19937& random, std::size_t symbols) {
  std::vector<std::uint32_t> counts(symbols);
  for (std::uint32_t& count : counts)
    count = random() % 3 == 0 ? 0 : static_cast<std::uint32_t>(random() >> (random() % 24 + 8));
  counts[random() % symbols] = 1; // at least one occurs
  return counts;
}

TEST(Huffman, CodesAreTheShortestInAllWhereTheLimitDoesNotBite) {
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    const std::vector<std::uint32_t> counts = randomCounts(random, 2 + random() % 285);
    const Measured measured = measure(counts, codesOf(counts, 30));
    ASSERT_EQ(measured.total, bestTotal(counts)) << "round " << round;
  }
}

TEST(Huffman, LimitedCodesAreCompleteAndNearTheBest) {
  std::mt19937 random(2);
  for (int round = 0; round < 300; ++round) {
    const std::vector<std::uint32_t> counts = randomCounts(random, 2 + random() % 285);
    const std::vector<HuffmanCode> codes = codesOf(counts, 10);
    const Measured measured = measure(counts, codes);
    ASSERT_LE(measured.longest, 10U);
    if (measured.longest > 1) {
      ASSERT_EQ(measured.kraft, 1.0) << "round " << round;
    }
    ASSERT_LE(static_cast<double>(measured.total), 1.25 * static_cast<double>(bestTotal(counts)) + 300.0);
  }
}

TEST(Huffman, FibonacciCountsMakeTheDeepestTreeAndAreLimited) {
  std::vector<std::uint32_t> counts{1, 1};
  while (counts.size() < 44) counts.push_back(counts[counts.size() - 1] + counts[counts.size() - 2]);
  for (const unsigned limit : {7U, 15U}) {
    const Measured measured = measure(counts, codesOf(counts, limit));
    EXPECT_EQ(measured.longest, limit);
    EXPECT_EQ(measured.kraft, 1.0);
  }
}

TEST(Huffman, CodesAreCanonicalAndNoneBeginsAnother) {
  // RFC 1951, 3.2.2: lengths (3, 3, 3, 3, 3, 2, 4, 4) of A … H give 010, 011, 100, 101, 110, 00, 1110, 1111.
  const std::vector<HuffmanCode> codes = codesOf({5, 5, 5, 5, 5, 11, 2, 2}, 15);
  const std::array<std::uint16_t, 8> reversed{0b010, 0b110, 0b001, 0b101, 0b011, 0b00, 0b0111, 0b1111};
  const std::array<std::uint8_t, 8> lengths{3, 3, 3, 3, 3, 2, 4, 4};
  for (std::size_t i = 0; i < codes.size(); ++i) {
    EXPECT_EQ(codes[i].length, lengths[i]) << i;
    EXPECT_EQ(codes[i].bits, reversed[i]) << i;
  }
}

TEST(Huffman, OneSymbolHasACodeOfOneBitAndNoneHasNone) {
  const std::vector<HuffmanCode> one = codesOf({0, 7, 0}, 15);
  EXPECT_EQ(one[1].length, 1);
  EXPECT_EQ(one[0].length + one[2].length, 0);
  for (const HuffmanCode& code : codesOf({0, 0, 0}, 15)) EXPECT_EQ(code.length, 0);
}

} // namespace
} // namespace offstage
