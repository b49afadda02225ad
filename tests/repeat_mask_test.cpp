#include "render/output/repeat_mask.h"

#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace offstage {
namespace {

/// Held to a comparison byte by byte.
void expectRuns(bool wide) {
  std::mt19937 random(7); // NOLINT(bugprone-random-generator-seed): the same in every run
  for (const std::size_t bytes : {1U, 31U, 63U, 64U, 65U, 127U, 128U, 200U, 1000U}) {
    for (const std::size_t distance : {3U, 4U, 100U}) {
      std::vector<std::uint8_t> row(distance + bytes);
      for (std::uint8_t& byte : row) byte = random() % 16 == 0 ? 1 : 0;
      RepeatMask mask(bytes, wide);
      mask.compare(row.data() + distance, distance);
      for (std::size_t at = 0; at <= bytes; ++at) {
        std::size_t run = 0;
        while (at + run < bytes && row[distance + at + run] == row[at + run]) ++run;
        ASSERT_EQ(mask.run(at), run) << "at " << at << " of " << bytes << " bytes, " << distance << " before";
      }
    }
  }
}

TEST(RepeatMask, FindsEveryRunAtAnyWidth) {
  expectRuns(false);
  if (processorIsWide()) expectRuns(true);
}

} // namespace
} // namespace offstage
