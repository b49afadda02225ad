#include "render/raster/batch_planner.h"
#include "tests/support/quads.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

constexpr ProgramKind kDisc{Coverage::Disc, PaintSource::Color, Footprint::Point};
constexpr ProgramKind kRing{Coverage::Ring, PaintSource::Color, Footprint::Point};
constexpr ProgramKind kBox{Coverage::Box, PaintSource::Color, Footprint::Quad};

TEST(BatchPlanner, FilledAndStrokedBodiesApartTakeOneBatchAMaterial) {
  BatchPlanner planner(640, 480);
  std::vector<ProgramKind> programs;
  std::vector<Instance> instances;
  for (int i = 0; i < 100; ++i) {
    for (const ProgramKind& program : {kDisc, kRing}) {
      programs.push_back(program);
      instances.push_back(quad(i % 10 * 64, i / 10 * 48, 32, 32));
    }
  }
  const auto batches = planner.plan(programs, instances);
  ASSERT_EQ(batches.size(), 2U);
  EXPECT_EQ(batches[0].program, kDisc);
  EXPECT_EQ(batches[0].members.size(), 100U);
  EXPECT_EQ(batches[1].program, kRing);
  EXPECT_EQ(batches[1].members.size(), 100U);
}

TEST(BatchPlanner, KeepsTheOrderOfWhatOverlapsAndDrawsEachOnce) {
  std::mt19937 random(17);
  for (int round = 0; round < 30; ++round) {
    BatchPlanner planner(333, 217);
    std::vector<ProgramKind> programs;
    std::vector<Instance> instances;
    const ProgramKind kinds[] = {kDisc, kRing, kBox};
    for (int i = 0; i < 300; ++i) {
      programs.push_back(kinds[random() % 3]);
      const int side = 1 + static_cast<int>(random() % 40);
      instances.push_back(
          quad(static_cast<int>(random() % 290), static_cast<int>(random() % 170), side, side));
    }
    std::vector<std::size_t> position(instances.size());
    std::size_t drawn = 0;
    for (const BatchPlanner::Batch& batch : planner.plan(programs, instances)) {
      for (const std::uint32_t i : batch.members) {
        EXPECT_EQ(batch.program, programs[i]);
        position[i] = ++drawn;
      }
    }
    EXPECT_EQ(drawn, instances.size());
    for (std::size_t i = 0; i < instances.size(); ++i) {
      for (std::size_t j = i + 1; j < instances.size(); ++j) {
        EXPECT_TRUE(!overlap(instances[i], instances[j]) || position[i] < position[j]) << i << " and " << j;
      }
    }
  }
}

TEST(BatchPlanner, NothingNeedsNoBatch) {
  BatchPlanner planner(1, 1);
  EXPECT_TRUE(planner.plan({}, {}).empty());
}

} // namespace
} // namespace offstage::test
