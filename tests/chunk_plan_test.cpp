#include "render/output/chunk_plan.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace offstage {
namespace {

TEST(ChunkPlan, CoversEveryFrameOnceInChunksOfEvenLength) {
  for (const std::int64_t frames :
       {0L, 1L, 47L, 48L, 60L, 300L, 479L, 480L, 481L, 960L, 961L, 12345L, 100000000L}) {
    const ChunkPlan plan(frames);
    EXPECT_EQ(plan.begin(0), 0) << frames;
    EXPECT_EQ(plan.begin(plan.chunks()), frames);
    std::int64_t shortest = frames;
    std::int64_t longest = 0;
    for (std::int64_t chunk = 0; chunk < std::min<std::int64_t>(plan.chunks(), 1000); ++chunk) {
      const std::int64_t length = plan.begin(chunk + 1) - plan.begin(chunk);
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
    EXPECT_LE(longest - shortest, 1) << frames;
    EXPECT_LE(longest, kMostChunkFrames) << frames;
  }
}

TEST(ChunkPlan, TwoWorkersAndInLongVideosFourShareEvenly) {
  EXPECT_EQ(ChunkPlan(47).chunks(), 1);
  EXPECT_EQ(ChunkPlan(60).chunks(), 2);
  EXPECT_EQ(ChunkPlan(300).chunks(), 2);
  EXPECT_EQ(ChunkPlan(480).chunks(), 4);
  EXPECT_EQ(ChunkPlan(960).chunks(), 4);
  EXPECT_EQ(ChunkPlan(961).chunks(), 8);
}

} // namespace
} // namespace offstage
