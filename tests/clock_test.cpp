#include "src/sim/clock.h"
#include "src/sim/error.h"
#include "tests/support/oracle_case.h"
#include "tests/support/reference_csv.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

class RecordedClock : public testing::TestWithParam<std::string> {};

TEST_P(RecordedClock, EqualsTheLecturesClockBitForBit) {
  const Clock clock = oracleClock(referenceFolder() / "trajectories/dt" / (GetParam() + ".txt"));
  const ReferenceCsv reference(referenceFolder() / "trajectories/out" /
                               ("0_clock__" + GetParam() + ".csv.gz"));
  ASSERT_EQ(static_cast<std::size_t>(clock.steps()), reference.rows());
  for (std::int64_t frame = 1; frame <= clock.steps(); ++frame) {
    const auto row = static_cast<std::size_t>(frame - 1);
    const Tick tick = clock.tick(frame);
    EXPECT_EQ(clock.nanoseconds(frame), reference.integer(row, "elapsed_ns"));
    EXPECT_TRUE(sameBits(tick.time, reference.hex(row, "currentTime_hex")))
        << "frame " << frame << show(tick.time);
    EXPECT_TRUE(sameBits(tick.dt, reference.hex(row, "frameDelta_hex")))
        << "frame " << frame << show(tick.dt);
  }
}

INSTANTIATE_TEST_SUITE_P(Oracle, RecordedClock, testing::Values("dt60", "dtfx"));

TEST(Clock, DtIsDifferenceOfTimesNotTheLoggedDuration) {
  const Clock clock = Clock::recorded({16666667, 16666667, 16666666});
  EXPECT_NE(clock.tick(3).dt, 16666666 / 1e9);
  EXPECT_EQ(clock.tick(3).dt, 0.05 - 33333334 / 1e9);
}

TEST(Clock, FixedStepsAreOneDivisionEach) {
  const Clock clock = Clock::fixed(60.0, 100);
  EXPECT_EQ(clock.time(7), 7.0 / 60.0);
  EXPECT_EQ(clock.tick(7).dt, 1.0 / 60.0);
  EXPECT_EQ(clock.tick(7).frame, 7);
  EXPECT_EQ(clock.nanoseconds(1), 16666667);
  EXPECT_EQ(clock.duration(), 100.0 / 60.0);
  EXPECT_TRUE(clock.isFixed());
}

TEST(Clock, FrameAtIsTheLastFrameThatIsNotAfterTheTime) {
  const Clock fixed = Clock::fixed(30.0, 90);
  for (std::int64_t frame = 0; frame <= 90; ++frame) {
    EXPECT_EQ(fixed.frameAt(fixed.time(frame)), frame);
    EXPECT_EQ(fixed.frameAt(std::nextafter(fixed.time(frame), -1.0)), std::max<std::int64_t>(frame - 1, 0));
  }
  EXPECT_EQ(fixed.frameAt(1e300), 90);
  EXPECT_EQ(fixed.frameAt(-1.0), 0);
  EXPECT_EQ(fixed.frameAt(std::nan("")), 0);
  const Clock recorded = Clock::recorded({100, 0, 50});
  EXPECT_EQ(recorded.frameAt(100e-9), 2) << "of two frames at the same time the later one";
  EXPECT_EQ(recorded.frameAt(149e-9), 2);
}

TEST(Clock, TruncatedKeepsTheFirstSteps) {
  const Clock recorded = Clock::recorded({10, 20, 30}).truncated(2);
  EXPECT_EQ(recorded.steps(), 2);
  EXPECT_EQ(recorded.nanoseconds(2), 30);
  EXPECT_THROW(static_cast<void>(recorded.time(3)), std::out_of_range);
  EXPECT_EQ(Clock::fixed(60, 5).truncated(9).steps(), 5);
  EXPECT_EQ(Clock::fixed(60, 5).truncated(-1).steps(), 0);
}

TEST(Clock, EmptyRecordingHasFrameZeroOnly) {
  const Clock clock = Clock::recorded({});
  EXPECT_EQ(clock.steps(), 0);
  EXPECT_EQ(clock.time(0), 0.0);
  EXPECT_FALSE(clock.isFixed());
  EXPECT_THROW(static_cast<void>(clock.tick(1)), std::out_of_range);
  EXPECT_THROW(static_cast<void>(clock.tick(0)), std::out_of_range);
}

TEST(Clock, RefusesWhatIsNoClock) {
  EXPECT_THROW(Clock::fixed(0.0, 1), Error);
  EXPECT_THROW(Clock::fixed(-60.0, 1), Error);
  EXPECT_THROW(Clock::fixed(std::nan(""), 1), Error);
  EXPECT_THROW(Clock::fixed(std::numeric_limits<double>::infinity(), 1), Error);
  EXPECT_THROW(Clock::fixed(60.0, -1), Error);
  EXPECT_THROW(Clock::recorded({5, -1}), Error);
  EXPECT_THROW(Clock::recorded({std::numeric_limits<std::int64_t>::max(), 1}), Error);
}

} // namespace
} // namespace offstage::test
