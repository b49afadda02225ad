#include "src/sim/contact.h"
#include "src/sim/impact_time.h"
#include "src/sim/random.h"
#include "tests/support/sim_setup.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

constexpr double kLong = 1e9;
const Vec2 kStill = Vec2::Zero();

TEST(ImpactTime, CirclesMeetWhenTheirDistanceIsTheSumOfTheirRadii) {
  // Head-on: (100 − 30)/(50 + 20).
  const auto headOn = timeOfImpact(circle(0, 0, 10), Vec2(50, 0), circle(100, 0, 20), Vec2(-20, 0), kLong);
  ASSERT_TRUE(headOn.has_value());
  EXPECT_NEAR(headOn->time, 1.0, 1e-15);
  EXPECT_EQ(headOn->normal, Vec2(1, 0));
  // Off-centre by 3 with radii 5: they touch when 4 apart along the way.
  const auto offCentre = timeOfImpact(circle(0, 0, 2), Vec2(6000, 0), circle(100, 3, 3), kStill, kLong);
  ASSERT_TRUE(offCentre.has_value());
  EXPECT_NEAR(offCentre->time, 96.0 / 6000.0, 1e-15);
  EXPECT_LT(length(offCentre->normal - Vec2(0.8, 0.6)), 1e-12);
}

TEST(ImpactTime, NoImpactOfThoseThatGrazePartOrOverlap) {
  EXPECT_FALSE(timeOfImpact(circle(0, 0, 2), Vec2(10, 0), circle(100, 5, 3), kStill, kLong)) << "graze";
  EXPECT_FALSE(timeOfImpact(circle(0, 0, 2), Vec2(10, 0), circle(100, 5.001, 3), kStill, kLong)) << "miss";
  EXPECT_TRUE(timeOfImpact(circle(0, 0, 2), Vec2(10, 0), circle(100, 4.999, 3), kStill, kLong));
  EXPECT_FALSE(timeOfImpact(circle(0, 0, 2), Vec2(-10, 0), circle(100, 0, 3), kStill, kLong))
      << "the other way";
  EXPECT_FALSE(timeOfImpact(circle(0, 0, 2), Vec2(10, 0), circle(3, 0, 3), kStill, kLong)) << "overlap";
  EXPECT_FALSE(timeOfImpact(circle(0, 0, 2), Vec2(10, 0), circle(100, 0, 3), kStill, 9.4)) << "too late";
  EXPECT_FALSE(timeOfImpact(circle(0, 0, 0), Vec2(10, 0), circle(100, 0, 0), kStill, kLong)) << "points";
  EXPECT_FALSE(timeOfImpact(rectangle(0, 0, 9, 9), Vec2(10, 0), rectangle(50, 9, 9, 9), kStill, kLong))
      << "graze";
  EXPECT_FALSE(timeOfImpact(rectangle(0, 0, 9, 9), Vec2(10, 0), rectangle(8, 8, 9, 9), kStill, kLong))
      << "overlap";
  EXPECT_FALSE(timeOfImpact(rectangle(0, 0, 9, 9), Vec2(10, 0), circle(5, 5, 1), kStill, kLong)) << "inside";
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Body& body : {circle(50, 0, 5), rectangle(50, 0, 5, 5)}) {
    EXPECT_FALSE(timeOfImpact(circle(nan, 0, 2), Vec2(10, 0), body, kStill, kLong));
    EXPECT_FALSE(timeOfImpact(rectangle(0, nan, 2, 2), Vec2(10, 0), body, kStill, kLong));
    EXPECT_FALSE(timeOfImpact(circle(0, 0, 2), Vec2(nan, 0), body, kStill, kLong));
  }
}

TEST(ImpactTime, CircleMeetsARectanglesSideOrCorner) {
  const Body box = rectangle(100, 100, 60, 40); // to (160, 140)
  const auto side = timeOfImpact(circle(20, 120, 10), Vec2(140, 0), box, kStill, kLong);
  ASSERT_TRUE(side.has_value());
  EXPECT_NEAR(side->time, 0.5, 1e-15);
  EXPECT_EQ(side->normal, Vec2(1, 0)) << "from the circle to the rectangle";
  const auto turned = timeOfImpact(box, kStill, circle(20, 120, 10), Vec2(140, 0), kLong);
  ASSERT_TRUE(turned.has_value());
  EXPECT_EQ(turned->normal, Vec2(-1, 0));
  // Along y = 94, 6 above the corner's height: its centre is 8 before the corner when they touch.
  const auto corner = timeOfImpact(box, kStill, circle(0, 94, 10), Vec2(92, 0), kLong);
  ASSERT_TRUE(corner.has_value());
  EXPECT_NEAR(corner->time, 1.0, 1e-15);
  EXPECT_LT(length(corner->normal - Vec2(-0.8, -0.6)), 1e-12);
  EXPECT_FALSE(timeOfImpact(box, kStill, circle(0, 90, 10), Vec2(92, 0), kLong)) << "past the corner";
  // A moving rectangle, a circle at rest.
  const auto rammed = timeOfImpact(box, Vec2(0, -30), circle(130, 60, 10), kStill, kLong);
  ASSERT_TRUE(rammed.has_value());
  EXPECT_NEAR(rammed->time, 1.0, 1e-15);
  EXPECT_EQ(rammed->normal, Vec2(0, -1));
}

TEST(ImpactTime, RectanglesMeetWhenBothTheirExtentsOverlap) {
  const Body box = rectangle(100, 100, 60, 40);
  const auto along = timeOfImpact(rectangle(0, 90, 20, 20), Vec2(160, 0), box, kStill, kLong);
  ASSERT_TRUE(along.has_value());
  EXPECT_NEAR(along->time, 0.5, 1e-15);
  EXPECT_EQ(along->normal, Vec2(1, 0));
  // x overlaps after 0.5 s, y after 1 s, x no more after 2 s.
  const auto diagonal = timeOfImpact(box, kStill, rectangle(0, 180, 60, 20), Vec2(80, -40), kLong);
  ASSERT_TRUE(diagonal.has_value());
  EXPECT_NEAR(diagonal->time, 1.0, 1e-15);
  EXPECT_EQ(diagonal->normal, Vec2(0, 1));
  EXPECT_FALSE(timeOfImpact(box, kStill, rectangle(0, 180, 60, 20), Vec2(80, -15), kLong)) << "past by then";
}

TEST(ImpactTime, TouchesToWithin1e9SecondsOfWhereFindContactBegins) {
  // At the impact minus 1 ns they are apart, plus 1 ns they overlap: for any two shapes.
  Random random(17);
  const auto draw = [&](double x) {
    const double y = random.nextDouble() * 60.0;
    const double a = 1.0 + random.nextDouble() * 20.0;
    return random.nextBoolean() ? circle(x, y, a) : rectangle(x, y, a, 1.0 + random.nextDouble() * 20.0);
  };
  int met = 0;
  for (int i = 0; i < 20000; ++i) {
    const Body first = draw(0.0);
    const Body second = draw(100.0);
    const Vec2 v1(100.0 + random.nextDouble() * 6000.0, random.nextGaussian() * 900.0);
    const Vec2 v2(random.nextGaussian() * 80.0, random.nextGaussian() * 80.0);
    const auto overlapsAt = [&](double time) {
      Body a = first;
      Body b = second;
      a.position += v1 * time;
      b.position += v2 * time;
      return findContact(a, b).has_value();
    };
    const auto impact = timeOfImpact(first, v1, second, v2, 10.0);
    if (!impact) {
      for (int moment = 0; moment < 750; ++moment) {
        const double time = 0.0004 * moment;
        ASSERT_FALSE(overlapsAt(time)) << "pair " << i << " overlaps at " << time << " but never meets";
      }
      continue;
    }
    ++met;
    const double closing = dot(v1 - v2, impact->normal);
    ASSERT_GT(closing, 0.0) << "pair " << i;
    EXPECT_FALSE(overlapsAt(impact->time - 1e-9)) << "pair " << i;
    if (closing < 100.0) continue; // nearly a graze: a nanosecond is less than a rounding
    EXPECT_TRUE(overlapsAt(impact->time + 1e-9)) << "pair " << i;
  }
  EXPECT_GT(met, 5000);
}

} // namespace
} // namespace offstage::test
