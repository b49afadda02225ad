#include "src/sim/contact.h"
#include "src/sim/random.h"
#include "src/sim/world.h"
#include "tests/support/reference_csv.h"
#include "tests/support/sim_setup.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

Contact along(const Vec2& normal) {
  return {normal, 0.0, 1.0};
}

double energy(const std::vector<Body>& bodies) {
  double sum = 0.0;
  for (const Body& body : bodies) sum += 0.5 * body.mass * dot(body.velocity, body.velocity);
  return sum;
}

Vec2 momentum(const std::vector<Body>& bodies) {
  Vec2 sum = Vec2::Zero();
  for (const Body& body : bodies) sum += body.mass * body.velocity;
  return sum;
}

/// `count` approaching collisions of bodies drawn at random, one after the other in the same crowd.
void collide(std::vector<Body>& bodies, Random& random, int count) {
  for (int done = 0; done < count;) {
    const auto i = static_cast<std::size_t>(random.nextInt(static_cast<std::int32_t>(bodies.size())));
    const auto j = static_cast<std::size_t>(random.nextInt(static_cast<std::int32_t>(bodies.size())));
    if (i == j) continue;
    bodies[i].position = Vec2(random.nextDouble(), random.nextDouble());
    bodies[j].position = Vec2(random.nextDouble(), random.nextDouble());
    const auto contact = findContact(bodies[i], bodies[j]);
    ASSERT_TRUE(contact.has_value());
    const ContactRule rule;
    if (!responds(rule, *contact, bodies[i], bodies[j])) continue;
    respond(rule, *contact, bodies[i], bodies[j]);
    ++done;
  }
}

TEST(Contact, BounceKeepsMomentumAndEnergyTo1e12Over10000Collisions) {
  for (const bool equalMasses : {true, false}) {
    Random random(2022);
    std::vector<Body> bodies;
    double momentumScale = 0.0;
    for (int i = 0; i < 24; ++i) {
      const double vx = random.nextGaussian() * 100.0;
      const double vy = random.nextGaussian() * 100.0;
      bodies.push_back(circle(0, 0, 5, Vec2(vx, vy), equalMasses ? 1.0 : 0.1 + 10.0 * random.nextDouble()));
      momentumScale += bodies.back().mass * length(bodies.back().velocity);
    }
    const double e0 = energy(bodies);
    const Vec2 p0 = momentum(bodies);
    collide(bodies, random, 10000);
    EXPECT_NEAR(energy(bodies) / e0, 1.0, 1e-12) << (equalMasses ? "equal masses" : "different masses");
    EXPECT_LT(length(momentum(bodies) - p0) / momentumScale, 1e-12);
  }
}

TEST(Contact, BounceOfEqualMassesExchangesTheNormalPartsExactly) {
  Body first = circle(0, 0, 10, Vec2(3, 7));
  Body second = circle(15, 0, 10, Vec2(-2, -0.5));
  const auto contact = findContact(first, second);
  ASSERT_TRUE(contact.has_value());
  respond({}, *contact, first, second);
  EXPECT_EQ(first.velocity, Vec2(-2, 7));
  EXPECT_EQ(second.velocity, Vec2(3, -0.5));
}

TEST(Contact, RestitutionIsTheShareOfTheClosingSpeedThatComesBack) {
  for (const double e : {0.0, 0.3, 1.0}) {
    Body first = circle(0, 0, 10, Vec2(30, 10), 2.0);
    Body second = circle(9, 12, 10, Vec2(-20, 5), 5.0);
    const Contact contact = findContact(first, second).value();
    const double before = closingSpeed(contact, first, second);
    const Vec2 momentumBefore = momentum({first, second});
    ContactRule rule;
    rule.restitution = e;
    respond(rule, contact, first, second);
    EXPECT_NEAR(closingSpeed(contact, first, second), -e * before, 1e-12) << "restitution " << e;
    EXPECT_LT(length(momentum({first, second}) - momentumBefore), 1e-12);
  }
}

struct SlideRow {
  Vec2 v1, v2, normal, expected1, expected2;
  double energyBefore, energyAfter;
};

TEST(Contact, SlideGainsEnergyExactlyAsItsFormulaSays) {
  // The reference's table of the printed formula.
  const std::vector<SlideRow> table{
      {Vec2(3, 0), Vec2(-3, 0), Vec2(1, 0), Vec2(6, 0), Vec2(-6, 0), 9, 36},
      {Vec2(5, 0), Vec2(0, 0), Vec2(1, 0), Vec2(5, 0), Vec2(-5, 0), 12.5, 25},
      {Vec2(5, 0), Vec2(2, 0), Vec2(1, 0), Vec2(3, 0), Vec2(-3, 0), 14.5, 9},
      {Vec2(30, 10), Vec2(-20, 5), Vec2(0.6, 0.8), Vec2(34.8, 16.4), Vec2(-35.6, -15.8), 712.5, 1498.5},
      {Vec2(0, 4), Vec2(0, -4), Vec2(1, 0), Vec2(0, 4), Vec2(0, -4), 16, 16}};
  ContactRule rule;
  rule.response = Response::Slide;
  for (const SlideRow& row : table) {
    Body first = circle(0, 0, 1, row.v1);
    Body second = circle(1, 0, 1, row.v2);
    EXPECT_NEAR(energy({first, second}), row.energyBefore, 1e-12);
    const Contact contact = along(row.normal);
    const double before = closingSpeed(contact, first, second);
    respond(rule, contact, first, second);
    EXPECT_LT(length(first.velocity - row.expected1), 1e-12) << first.velocity.transpose();
    EXPECT_LT(length(second.velocity - row.expected2), 1e-12) << second.velocity.transpose();
    EXPECT_NEAR(energy({first, second}), row.energyAfter, 1e-10);
    EXPECT_NEAR(closingSpeed(contact, first, second), 2.0 * before, 1e-12)
        << "the closing speed keeps its sign";
  }
}

TEST(Contact, SlideGainsWhatItsFormulaSaysForAnyPair) {
  // E' − E = ½·(2·(v1n − v2n)² − v1n² − v2n²): the normal parts become ±(v1n − v2n), the tangential ones
  // stay.
  Random random(11);
  ContactRule rule;
  rule.response = Response::Slide;
  for (int i = 0; i < 1000; ++i) {
    Body first = circle(random.nextGaussian(), random.nextGaussian(), 9, Vec2(random.nextGaussian(), 2.0));
    Body second = circle(random.nextGaussian(), random.nextGaussian(), 9, Vec2(-1.0, random.nextGaussian()));
    const Contact contact = findContact(first, second).value();
    const double a = dot(first.velocity, contact.normal);
    const double b = dot(second.velocity, contact.normal);
    const double gain = 0.5 * (2.0 * (a - b) * (a - b) - a * a - b * b);
    const double before = energy({first, second});
    respond(rule, contact, first, second);
    EXPECT_NEAR(energy({first, second}) - before, gain, 1e-12 * (1.0 + std::abs(gain))) << "pair " << i;
  }
}

TEST(Contact, FixedBodyCountsAsInfiniteMassAtRest) {
  Body wall = circle(0, 0, 10, Vec2(99, 99), 0.001);
  wall.fixed = true;
  Body ball = circle(15, 0, 10, Vec2(-8, 3), 1000.0);
  for (const bool wallFirst : {true, false}) {
    Body a = wallFirst ? wall : ball;
    Body b = wallFirst ? ball : wall;
    const Contact contact = findContact(a, b).value();
    ContactRule rule;
    rule.restitution = 0.5;
    EXPECT_EQ(closingSpeed(contact, a, b), 8.0);
    ASSERT_TRUE(responds(rule, contact, a, b));
    respond(rule, contact, a, b);
    separate(contact, a, b);
    const Body& moved = wallFirst ? b : a;
    const Body& still = wallFirst ? a : b;
    EXPECT_EQ(moved.velocity, Vec2(4, 3));
    EXPECT_EQ(moved.position, Vec2(20, 0)) << "the whole overlap goes to the one that can move";
    EXPECT_EQ(still.velocity, Vec2(99, 99));
    EXPECT_EQ(still.position, Vec2(0, 0));
  }
  Body other = wall;
  const Contact contact = findContact(wall, other).value();
  ContactRule always;
  always.approachingOnly = false;
  EXPECT_FALSE(responds(always, contact, wall, other)) << "two fixed bodies do nothing";
  separate(contact, wall, other);
  EXPECT_EQ(wall.position, other.position);
}

TEST(Contact, CirclesTouchOnlyStrictlyBelowTheSumOfTheirRadii) {
  EXPECT_FALSE(findContact(circle(0, 0, 5), circle(8, 6, 5)).has_value());
  EXPECT_TRUE(findContact(circle(0, 0, 5), circle(8, 5.99999999, 5)).has_value());
  const Contact same = findContact(circle(3, 3, 5), circle(3, 3, 5)).value();
  EXPECT_EQ(same.normal, Vec2(1, 0)) << "coinciding centres";
  EXPECT_FALSE(findContact(circle(3, 3, 0), circle(3, 3, 0)).has_value());
}

TEST(Contact, SeparateMovesEachHalfTheOverlap) {
  Body first = circle(0, 0, 10);
  Body second = circle(12, 0, 10);
  separate(findContact(first, second).value(), first, second);
  EXPECT_EQ(first.position, Vec2(-4, 0));
  EXPECT_EQ(second.position, Vec2(16, 0));
}

struct CircleAtRectangle {
  const char* where;
  Vec2 centre;
  Vec2 normal; ///< from the rectangle to the circle; zero: no contact
  double distance;
};

TEST(Contact, CircleMeetsRectangleAtItsNearestPoint) {
  const Body box = rectangle(100, 100, 60, 40); // to (160, 140)
  const std::vector<CircleAtRectangle> cases{
      {"left", Vec2(94, 120), Vec2(-1, 0), 6},
      {"right", Vec2(169, 120), Vec2(1, 0), 9},
      {"top", Vec2(130, 92), Vec2(0, -1), 8},
      {"bottom", Vec2(130, 149), Vec2(0, 1), 9},
      {"upper left corner", Vec2(97, 96), Vec2(-0.6, -0.8), 5},
      {"lower right corner", Vec2(164, 143), Vec2(0.8, 0.6), 5},
      {"just off the corner", Vec2(154, 148) + Vec2(12, 0), Vec2(0, 0), 0},
      {"tangent", Vec2(90, 120), Vec2(0, 0), 0},
      {"inside, by the left", Vec2(103, 120), Vec2(-1, 0), -3},
      {"inside, by the bottom", Vec2(130, 138), Vec2(0, 1), -2},
      {"centre: top and bottom tie", Vec2(130, 120), Vec2(0, -1), -20},
      {"inside corner: left and top tie", Vec2(105, 105), Vec2(-1, 0), -5},
      {"on the edge", Vec2(160, 120), Vec2(1, 0), 0}};
  for (const CircleAtRectangle& c : cases) {
    const Body ball = circle(c.centre.x(), c.centre.y(), 10);
    const auto contact = findContact(box, ball);
    ASSERT_EQ(contact.has_value(), c.normal != Vec2(0, 0)) << c.where;
    if (!contact) continue;
    EXPECT_LT(length(contact->normal - c.normal), 1e-15) << c.where << ": " << contact->normal.transpose();
    EXPECT_EQ(contact->distance, c.distance) << c.where;
    EXPECT_EQ(contact->touch, 10.0) << c.where;
    const Contact turned = findContact(ball, box).value();
    EXPECT_EQ(turned.normal, -contact->normal) << c.where;
    EXPECT_EQ(turned.distance, contact->distance) << c.where;
    Body still = box;
    still.fixed = true;
    Body moved = ball;
    separate(*contact, still, moved);
    const auto after = findContact(still, moved);
    EXPECT_TRUE(!after || after->touch - after->distance < 1e-12) << c.where << ": still overlaps";
  }
}

TEST(Contact, RectanglesMeetAlongTheAxisOfLeastPenetration) {
  const Body box = rectangle(100, 100, 60, 40);
  const std::vector<std::pair<Body, Vec2>> cases{
      {rectangle(150, 110, 60, 20), Vec2(1, 0)},
      {rectangle(45, 110, 60, 20), Vec2(-1, 0)},
      {rectangle(110, 132, 20, 50), Vec2(0, 1)},
      {rectangle(110, 55, 20, 50), Vec2(0, -1)},
      {rectangle(102, 115, 10, 10), Vec2(-1, 0)}, // wholly inside
      {box, Vec2(0, -1)}};                        // the same: top and bottom are nearest, top first
  for (const auto& [other, normal] : cases) {
    const auto contact = findContact(box, other);
    ASSERT_TRUE(contact.has_value()) << other.position.transpose();
    EXPECT_EQ(contact->normal, normal) << other.position.transpose();
    Body first = box;
    Body second = other;
    first.fixed = true;
    separate(*contact, first, second);
    EXPECT_FALSE(findContact(first, second).has_value()) << "after pushing " << other.position.transpose();
  }
  EXPECT_FALSE(findContact(box, rectangle(160, 100, 5, 5)).has_value()) << "edges that meet do not overlap";
}

TEST(Contact, NanIsNoContact) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Body> bodies{circle(nan, 110, 10), circle(110, nan, 10), rectangle(nan, 110, 10, 10),
                                 rectangle(110, nan, 10, 10)};
  for (const Body& broken : bodies) {
    for (const Body& whole : {circle(110, 110, 50), rectangle(100, 100, 60, 40)}) {
      EXPECT_FALSE(findContact(broken, whole).has_value());
      EXPECT_FALSE(findContact(whole, broken).has_value());
    }
  }
}

TEST(Contact, RuleIsFoundByTheTwoGroupsInEitherOrder) {
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  setup.groups = {"a", "b", "c"};
  setup.bodies = {circle(100, 100, 20), circle(110, 100, 20), circle(120, 100, 20)};
  setup.bodies[0].group = 2;
  setup.bodies[1].group = 0;
  setup.bodies[2].group = 1;
  setup.contacts.push_back({.groupA = 0, .groupB = 2, .response = Response::Report});
  World world(setup);
  world.step({1, 0.1, 0.1});
  ASSERT_EQ(world.events().size(), 1U);
  EXPECT_EQ(world.events()[0].kind, EventKind::Touch);
  EXPECT_EQ(world.events()[0].first, 0);
  EXPECT_EQ(world.events()[0].second, 1);
  EXPECT_EQ(world.events()[0].p, 10.0);
  EXPECT_EQ(world.events()[0].q, 40.0);
  EXPECT_EQ(world.bodies()[0].position, Vec2(100, 100)) << "a report changes nothing";
}

TEST(Contact, CollideIsReportedOnlyWhenVelocitiesChange) {
  WorldSetup setup;
  setup.gravity = Vec2::Zero();
  setup.bodies = {circle(100, 100, 20, Vec2(-1, 0)), circle(110, 100, 20, Vec2(1, 0))};
  setup.contacts.push_back({});
  World world(setup);
  world.step({1, 0.1, 0.1});
  EXPECT_TRUE(world.events().empty()) << "they separate, so that nothing but their overlap is put right";
  EXPECT_NEAR(world.bodies()[1].position.x() - world.bodies()[0].position.x(), 40.0, 1e-12);
}

} // namespace
} // namespace offstage::test
