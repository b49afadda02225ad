#include "src/scene/time_map.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

std::vector<double> positions(const TimeMap& map) {
  std::vector<double> all;
  for (std::int64_t frame = 0; frame <= map.frames(); ++frame) all.push_back(map.position(frame));
  return all;
}

TEST(TimeMap, WithoutAnythingIsTheIdentity) {
  const TimeMap map(3);
  EXPECT_TRUE(map.isIdentity());
  EXPECT_THAT(positions(map), ElementsAre(0, 1, 2, 3));
}

TEST(TimeMap, SlowMotionShowsPlacesBetweenFramesAndFastForwardSkipsFrames) {
  const TimeMap slow(4, {{1, 3, 4}});
  EXPECT_FALSE(slow.isIdentity());
  EXPECT_THAT(positions(slow), ElementsAre(0, 1, 1.5, 2, 2.5, 3, 4));
  EXPECT_FALSE(slow.isSlow(0));
  EXPECT_TRUE(slow.isSlow(1));
  EXPECT_FALSE(slow.isSlow(5));
  const TimeMap fast(8, {{0, 8, 2}});
  EXPECT_THAT(positions(fast), ElementsAre(0, 4, 8));
}

TEST(TimeMap, StandsWhereItIsToldAndShowsThatPosition) {
  TimeMap map(4, {{1, 3, 4}});
  map.stand(map.firstAt(2.0), 2, 2.0, 7);
  EXPECT_THAT(positions(map), ElementsAre(0, 1, 1.5, 2, 2, 2, 2.5, 3, 4));
  EXPECT_THAT(map.range(7), Pair(3, 5));
  EXPECT_THAT(map.range(8), Pair(0, 0));
  map.stand(0, 1);
  map.stand(map.frames(), 2);
  EXPECT_THAT(positions(map), ElementsAre(0, 0, 1, 1.5, 2, 2, 2, 2.5, 3, 4, 4, 4));
  EXPECT_THAT(map.range(7), Pair(4, 6));
}

TEST(TimeMap, AStandWithinAStandKeepsItsTag) {
  TimeMap map(3);
  map.stand(1, 4, 1.0, 5);
  map.stand(3, 2);
  EXPECT_EQ(map.frames(), 9);
  EXPECT_THAT(map.range(5), Pair(1, 7));
  EXPECT_THAT(positions(map), ElementsAre(0, 1, 1, 1, 1, 1, 1, 1, 2, 3));
}

TEST(TimeMap, InverseGivesTheBeginningOfAStand) {
  TimeMap map(10, {{4, 6, 8}});
  map.stand(map.firstAt(2.0), 5, 2.0);
  EXPECT_DOUBLE_EQ(map.inverse(0.0), 0.0);
  EXPECT_DOUBLE_EQ(map.inverse(1.5), 1.5);
  EXPECT_DOUBLE_EQ(map.inverse(2.0), 2.0);
  EXPECT_DOUBLE_EQ(map.inverse(2.5), 7.5);
  EXPECT_DOUBLE_EQ(map.inverse(4.5), 11.0);
  EXPECT_DOUBLE_EQ(map.inverse(10.0), 21.0);
  EXPECT_DOUBLE_EQ(map.inverse(99.0), 21.0);
}

TEST(TimeMap, PositionsNeverGoBack) {
  TimeMap map(100, {{10, 17, 23}, {40, 80, 7}});
  map.stand(map.firstAt(12.0), 9, 12.0);
  map.stand(30, 4);
  map.stand(map.firstAt(50.0), 3, 50.0);
  double before = -1.0;
  for (const double position : positions(map)) {
    EXPECT_GE(position, before);
    before = position;
  }
  EXPECT_EQ(before, 100.0);
  EXPECT_EQ(map.frames(), 10 + 23 + 23 + 7 + 20 + 9 + 4 + 3);
}

} // namespace
} // namespace offstage
