#include "src/scene/trace_compare.h"
#include "tests/support/oracle_case.h"
#include "tests/support/reference_csv.h"

#include <chrono>
#include <limits>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Trace oracle(const std::string& name) {
  const std::filesystem::path file = referenceFolder() / (name + "__dt60.csv.gz");
  return parseTrace(readReferenceText(file), file);
}

Trace rows(const std::string& text) {
  return parseTrace("frame,time,id,x,y,radius\n" + text, "rows.csv");
}

/// A body that moves at a constant velocity, a frame a tenth of a second.
std::string moving(int id, int fromFrame, int toFrame, double x, double vx) {
  std::string text;
  for (int frame = fromFrame; frame <= toFrame; ++frame)
    text += fmt::format("{},{},{},{},50,5\n", frame, frame * 0.1, id, x + vx * 0.1 * (frame - fromFrame));
  return text;
}

TEST(TraceCompare, ATraceIsItself) {
  const Trace trace = oracle("trajectories/out/6a_elastic");
  const TraceComparison comparison = compareTraces(trace, trace, {});
  EXPECT_TRUE(comparison.same);
  EXPECT_EQ(comparison.compared, 2710);
  EXPECT_EQ(comparison.differing + comparison.missing + comparison.extra, 0);
  EXPECT_TRUE(comparison.velocityCompared);
  EXPECT_EQ(comparison.times.size(), comparison.positionError.size());
  EXPECT_THAT(describe(comparison),
              ElementsAre("2710 rows compared, 0 beyond the tolerance, 0 missing, 0 extra; 10 "
                          "and 10 bodies, matched by id"));
}

TEST(TraceCompare, TheExerciseWordForWordLeavesTheClampedOneWhenItSinksIntoTheFloor) {
  const TraceComparison comparison =
      compareTraces(oracle("trajectories/out/2a_bounce"), oracle("trajectories/out/2b_bounce_naive"), {});
  EXPECT_FALSE(comparison.same);
  ASSERT_TRUE(comparison.first);
  EXPECT_EQ(comparison.first->frame, 121);
  EXPECT_EQ(comparison.first->body, 0);
  EXPECT_EQ(comparison.first->quantity, TraceQuantity::Y);
  EXPECT_EQ(comparison.first->expected, 460.0);
  EXPECT_EQ(comparison.first->actual, 460.09272222886443);
  EXPECT_THAT(
      describe(comparison),
      Contains("first difference: frame 121 (2.01667 s), body 0: y is 460.09272222886443, expected 460 (off "
               "by 0.0927222 px)"));
}

TEST(TraceCompare, PushingApartLeavesTheElasticExchangeAtTheFirstHit) {
  const TraceComparison comparison = compareTraces(oracle("trajectories/out/6a_elastic"),
                                                   oracle("trajectories/out/6g_elastic_separate"), {});
  ASSERT_TRUE(comparison.first);
  EXPECT_EQ(comparison.first->frame, 342);
  EXPECT_EQ(comparison.first->body, 0); // and body 2, which it hits
  EXPECT_EQ(comparison.first->quantity, TraceQuantity::X);
  EXPECT_NEAR(comparison.first->error, 387.09802490924295 - 386.3580898125715, 1e-9);
}

TEST(TraceCompare, OneChangedDrawIsFoundWhereItsBodyAppears) {
  const Trace expected = oracle("trajectories/out/6a_elastic");
  const Trace actual = oracle("traces/6a_elastic_one_draw_changed");
  const TraceComparison comparison = compareTraces(expected, actual, {});
  ASSERT_TRUE(comparison.first);
  EXPECT_EQ(comparison.first->frame, 300);
  EXPECT_EQ(comparison.first->body, 4);
  EXPECT_EQ(comparison.first->quantity, TraceQuantity::Radius);
  EXPECT_EQ(comparison.first->error, 1.0);
  EXPECT_EQ(comparison.match, TraceMatch::Id);

  const TraceComparison byStart = compareTraces(expected, actual, {}, TraceMatch::Nearest);
  ASSERT_TRUE(byStart.first);
  EXPECT_EQ(byStart.first->frame, 300);
  EXPECT_EQ(byStart.first->body, 4);
  EXPECT_EQ(byStart.first->actualBody, 4);
}

TEST(TraceCompare, BodiesWithOtherNumbersAreMatchedByTheirNearestStart) {
  const Trace expected = oracle("trajectories/out/6a_elastic");
  Trace actual = expected;
  for (TraceRow& row : actual.rows) row.id = 100 - row.id;
  const TraceComparison comparison = compareTraces(expected, actual, {});
  EXPECT_EQ(comparison.match, TraceMatch::Nearest);
  EXPECT_TRUE(comparison.same) << describe(comparison).front();
  EXPECT_FALSE(compareTraces(expected, actual, {}, TraceMatch::Id).same);
}

TEST(TraceCompare, BodiesThatStartTogetherGetTheirOwnPartnersNotTheirNeighbours) {
  // By id, 0 would take 11, which is nearest to 1.
  const Trace expected = rows("0,0,0,100,0,1\n0,0,1,110,0,1\n0,0,2,300,0,1\n");
  const Trace actual = rows("0,0,10,85,0,1\n0,0,11,109,0,1\n0,0,12,300,40,1\n");
  const auto a = traceBodies(expected);
  const auto b = traceBodies(actual);
  const std::vector<TracePair> pairs = matchBodies(expected, a, actual, b, TraceMatch::Nearest);
  ASSERT_EQ(pairs.size(), 3U);
  for (const TracePair& pair : pairs) {
    ASSERT_TRUE(pair.expected && pair.actual);
    EXPECT_EQ(b[*pair.actual].id, a[*pair.expected].id + 10);
  }
}

TEST(TraceCompare, ABodyThatStartsMuchLaterIsAnotherOne) {
  const Trace expected = rows(moving(0, 0, 20, 10, 0));
  const Trace actual = rows(moving(0, 0, 20, 10, 0) + moving(1, 6, 20, 40, 0));
  const TraceComparison comparison = compareTraces(expected, actual, {});
  EXPECT_EQ(comparison.extra, 15);
  ASSERT_TRUE(comparison.firstPresence);
  EXPECT_EQ(comparison.firstPresence->frame, 6);
  EXPECT_EQ(comparison.firstPresence->body, 1);
  EXPECT_FALSE(comparison.firstPresence->inExpected);
  ASSERT_TRUE(comparison.firstEvent);
  EXPECT_EQ(comparison.firstEvent->event.kind, TraceEventKind::Spawn);
  EXPECT_THAT(
      describe(comparison),
      ElementsAre("frame 6 (0.6 s): body 1 is in the actual trace only",
                  "first event that differs: spawn of body 1 in frame 6 (0.6 s) of the actual trace; in the "
                  "expected one never",
                  "21 rows compared, 0 beyond the tolerance, 0 missing, 15 extra; 1 and 2 bodies, matched by "
                  "nearest start; velocities are not in both traces and were not compared"));
}

TEST(TraceCompare, ARemovalThatComesLaterIsNamed) {
  const Trace expected = rows(moving(0, 0, 20, 10, 0) + moving(1, 0, 9, 40, 0));
  const Trace actual = rows(moving(0, 0, 20, 10, 0) + moving(1, 0, 12, 40, 0));
  const TraceComparison comparison = compareTraces(expected, actual, {});
  ASSERT_TRUE(comparison.firstEvent);
  EXPECT_EQ(comparison.firstEvent->event.kind, TraceEventKind::Removal);
  EXPECT_EQ(comparison.firstEvent->event.frame, 10);
  EXPECT_EQ(comparison.firstEvent->otherFrame, 13);
  EXPECT_TRUE(comparison.firstEvent->inExpected);
}

/// A throw at dt 0.1 and 100 px/s² that turns at its top and may bounce at y = 100.
std::string thrown(bool bounces, bool withVelocity) {
  std::string text;
  double y = 80.0;
  double vy = -45.0;
  for (int frame = 0; frame <= 20; ++frame) {
    text += fmt::format("{},{},0,{},{}", frame, frame * 0.1, 10 + frame, y);
    text += withVelocity ? fmt::format(",{},{},5\n", 10, vy) : ",5\n";
    vy += 10.0;
    y += vy * 0.1;
    if (bounces && y > 100.0) {
      y = 100.0;
      vy = -vy;
    }
  }
  return text;
}

TEST(TraceCompare, AMissedBounceIsTheFirstEventButATurnAtTheTopIsNone) {
  for (const bool withVelocity : {true, false}) {
    const std::string header =
        withVelocity ? "frame,time,id,x,y,vx,vy,radius\n" : "frame,time,id,x,y,radius\n";
    const Trace expected = parseTrace(header + thrown(true, withVelocity), "a.csv");
    const Trace actual = parseTrace(header + thrown(false, withVelocity), "b.csv");
    const TraceComparison comparison = compareTraces(expected, actual, {});
    ASSERT_TRUE(comparison.firstEvent);
    EXPECT_EQ(comparison.firstEvent->event.kind, TraceEventKind::BounceY) << withVelocity;
    EXPECT_TRUE(comparison.firstEvent->inExpected);
    EXPECT_FALSE(comparison.firstEvent->otherFrame);
    ASSERT_TRUE(comparison.first);
    // Where velocities are given, the sign flips in the frame of the bounce; positions show it in the next.
    EXPECT_EQ(comparison.firstEvent->event.frame, comparison.first->frame + (withVelocity ? 0 : 1));
  }
}

TEST(TraceCompare, WithinTheToleranceItIsTheSame) {
  const Trace expected = parseTrace("frame,time,id,x,y,vx,vy,radius\n0,0,0,1,2,3,4,5\n", "a.csv");
  const Trace actual = parseTrace("frame,time,id,x,y,vx,vy,radius\n0,0.25,0,1.5,2,3.25,4,5\n", "b.csv");
  EXPECT_TRUE(compareTraces(expected, actual, {0.5, 0.25, 0.25}).same);
  EXPECT_EQ(compareTraces(expected, actual, {0.49, 0.25, 0.25}).first->quantity, TraceQuantity::X);
  EXPECT_EQ(compareTraces(expected, actual, {0.5, 0.24, 0.25}).first->quantity, TraceQuantity::Vx);
  EXPECT_EQ(compareTraces(expected, actual, {0.5, 0.25, 0.24}).first->quantity, TraceQuantity::Time);
  const TraceComparison within = compareTraces(expected, actual, {0.5, 0.25, 0.25});
  EXPECT_EQ(within.worst[static_cast<std::size_t>(TraceQuantity::X)]->error, 0.5); // told all the same
}

TEST(TraceCompare, ANumberThatIsNoneEqualsOnlyItsLike) {
  const Trace nan = rows("0,0,0,NaN,2,5\n");
  EXPECT_TRUE(compareTraces(nan, nan, {}).same);
  const TraceComparison comparison = compareTraces(rows("0,0,0,1,2,5\n"), nan, {1e9, 1e9, 1e9});
  ASSERT_TRUE(comparison.first);
  EXPECT_EQ(comparison.first->error, std::numeric_limits<double>::infinity());
  EXPECT_THAT(describe(comparison).front(), HasSubstr("x is nan, expected 1"));
}

TEST(TraceCompare, ATraceThatEndsEarlierSaysSo) {
  const TraceComparison comparison =
      compareTraces(rows(moving(0, 0, 20, 0, 10)), rows(moving(0, 0, 14, 0, 10)), {});
  EXPECT_FALSE(comparison.same);
  EXPECT_EQ(comparison.missing, 6);
  EXPECT_FALSE(comparison.firstPresence);
  EXPECT_FALSE(comparison.firstEvent);
  EXPECT_THAT(describe(comparison).front(),
              "the expected trace ends with frame 20, the actual one with frame 14");
}

TEST(TraceCompare, ATraceWithoutRowsHasNoFrame) {
  const Trace none = rows("");
  const Trace some = rows(moving(0, 0, 20, 0, 10));
  EXPECT_THAT(describe(compareTraces(some, none, {})),
              Contains("the expected trace ends with frame 20, the actual one has no frame"));
  EXPECT_THAT(describe(compareTraces(none, some, {})),
              Contains("the expected trace has no frame, the actual one ends with frame 20"));
}

TEST(TraceCompare, ErrorOverTime) {
  const TraceComparison comparison =
      compareTraces(rows("0,0,0,1,2,5\n1,0.5,0,1,2,5\n3,1.5,0,1,2,5\n"),
                    rows("0,0,0,1,2,5\n1,0.5,0,4,1,5\n2,1,0,9,9,9\n3,1.5,0,1,2,7\n"), {});
  EXPECT_THAT(comparison.times, ElementsAre(0, 0.5, 1.5));
  EXPECT_THAT(comparison.positionError, ElementsAre(0, 3, 2));
  EXPECT_TRUE(comparison.velocityError.empty());
}

TEST(TraceCompare, TenThousandBodiesThatStartTogetherAreMatchedInLittleTime) {
  std::string a;
  std::string b;
  for (int i = 0; i < 10000; ++i) {
    a += fmt::format("0,0,{},{},{},1\n", i, i % 100, i / 100);
    b += fmt::format("0,0,{},{},{},1\n", 20000 - i, i % 100, i / 100);
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(compareTraces(rows(a), rows(b), {}).same);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  EXPECT_LT(elapsed.count(), 20.0) << "s; a release build takes well below 1";
}

} // namespace
} // namespace offstage::test
