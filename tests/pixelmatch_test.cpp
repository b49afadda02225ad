#include "render/compare/frame_rows.h"
#include "render/compare/pixelmatch.h"
#include "tests/support/picture_pairs.h"
#include "tests/support/reference_csv.h"

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

TEST(Pixelmatch, CountsWhatVersion720Counts) {
  const ReferenceCsv reference(OFFSTAGE_SOURCE_DIR "/tests/reference/pixelmatch/counts.csv");
  ASSERT_GE(reference.rows(), 40U);
  for (std::size_t row = 0; row < reference.rows(); ++row) {
    const auto number = static_cast<int>(reference.integer(row, "pair"));
    const auto [a, b] = picturePair(number);
    ASSERT_EQ(pictureHash(a), reference.integer(row, "hash_a")) << "pair " << number << " is made otherwise";
    ASSERT_EQ(pictureHash(b), reference.integer(row, "hash_b")) << "pair " << number << " is made otherwise";
    for (const int threads : {1, 3}) {
      const PixelmatchCounts counts = pixelmatch(FrameRows(a), FrameRows(b), threads);
      EXPECT_EQ(counts.differing, reference.integer(row, "threshold_0.1")) << "pair " << number;
      EXPECT_EQ(counts.withAa, reference.integer(row, "threshold_0.1_includeAA")) << "pair " << number;
    }
  }
}

} // namespace
} // namespace offstage::test
