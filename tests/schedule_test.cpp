#include "render/job/schedule.h"
#include "src/sim/error.h"

#include <gtest/gtest.h>

namespace offstage {
namespace {

TEST(Schedule, FixedClockShowsEveryFrameButTheLast) {
  const Schedule schedule(Clock::fixed(60.0, 1200), {}, {}, {});
  EXPECT_EQ(schedule.frames(), 1200);
  EXPECT_EQ(schedule.simulated(0), 0);
  EXPECT_EQ(schedule.simulated(1199), 1199);
  EXPECT_DOUBLE_EQ(schedule.seconds(), 20.0);
  EXPECT_DOUBLE_EQ(schedule.fps(), 60.0);
  EXPECT_EQ(schedule.timing(1).start, 16'666'667);
  EXPECT_EQ(schedule.timing(1199).end, 20'000'000'000);
}

TEST(Schedule, FixedPartBeginsAtTheFirstFrameNotBeforeFromAndEndsBeforeTo) {
  const Schedule schedule(Clock::fixed(10.0, 100), 2.05, 3.0, {});
  EXPECT_EQ(schedule.simulated(0), 21);
  EXPECT_EQ(schedule.frames(), 9); // 2.1 … 2.9
  EXPECT_EQ(schedule.timing(0).start, 0);
  EXPECT_EQ(schedule.timing(8).end, 900'000'000);
}

TEST(Schedule, RecordedClockLastsExactlyAsLongAsTheLog) {
  const Schedule schedule(Clock::recorded({16'666'667, 250'000'001, 5}), {}, {}, {});
  ASSERT_EQ(schedule.frames(), 3);
  EXPECT_EQ(schedule.fps(), 0.0);
  EXPECT_EQ(schedule.timing(0).end, 16'666'667);
  EXPECT_EQ(schedule.timing(1).start, 16'666'667);
  EXPECT_EQ(schedule.timing(2).start, 266'666'668);
  EXPECT_EQ(schedule.timing(2).end, 266'666'673);
}

TEST(Schedule, RecordedPartBeginsWithTheFrameOnShow) {
  const Schedule schedule(Clock::recorded({100'000'000, 100'000'000, 100'000'000, 100'000'000}), 0.15, 0.35,
                          {});
  ASSERT_EQ(schedule.frames(), 3); // frames 1, 2, 3
  EXPECT_EQ(schedule.simulated(0), 1);
  EXPECT_EQ(schedule.timing(0).start, 0);
  EXPECT_EQ(schedule.timing(0).end, 50'000'000);
  EXPECT_EQ(schedule.timing(2).end, 200'000'000);
}

TEST(Schedule, ResamplingShowsTheLastFrameWhoseTimeHasCome) {
  const Schedule schedule(Clock::recorded({100'000'000, 300'000'000, 100'000'000}), {}, {}, 10.0);
  ASSERT_EQ(schedule.frames(), 5);
  const std::int64_t expected[] = {0, 1, 1, 1, 2};
  for (std::int64_t i = 0; i < 5; ++i) EXPECT_EQ(schedule.simulated(i), expected[i]) << "output frame " << i;
  EXPECT_EQ(schedule.timing(4).end, 500'000'000);
}

TEST(Schedule, RefusesAnEmptyOrOutsidePartAndAnAbsurdRate) {
  const Clock clock = Clock::fixed(60.0, 60);
  EXPECT_THROW(Schedule(clock, 0.5, 0.5, {}), Error);
  EXPECT_THROW(Schedule(clock, 0.8, 0.2, {}), Error);
  EXPECT_THROW(Schedule(clock, -0.1, {}, {}), Error);
  EXPECT_THROW(Schedule(clock, {}, 1.5, {}), Error);
  EXPECT_THROW(Schedule(clock, 0.501, 0.502, {}), Error);
  EXPECT_THROW(Schedule(Clock::fixed(60.0, 0), {}, {}, {}), Error);
  EXPECT_THROW(Schedule(Clock::recorded({1'000'000}), {}, {}, 0.0), Error);
}

} // namespace
} // namespace offstage
