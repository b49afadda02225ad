// The grid against the plain double loop, which is kept here: the same bits after every pass.
#include "src/sim/contact_solver.h"
#include "src/sim/random.h"
#include "tests/support/sim_setup.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// What a pass leaves behind.
struct Outcome {
  std::vector<Body> bodies;
  std::vector<std::uint8_t> removed;
  std::vector<Event> events;
};

Outcome before(const std::vector<Body>& bodies) {
  return {bodies, std::vector<std::uint8_t>(bodies.size(), 0), {}};
}

const ContactRule* ruleOf(const std::vector<ContactRule>& rules, const Body& first, const Body& second) {
  for (const ContactRule& rule : rules) {
    if ((rule.groupA == first.group && rule.groupB == second.group) ||
        (rule.groupB == first.group && rule.groupA == second.group)) {
      return &rule;
    }
  }
  return nullptr;
}

/// Every pair i < j, one after the other.
void solvePlainly(const std::vector<ContactRule>& rules, Outcome& outcome) {
  std::vector<bool> gone(outcome.bodies.size(), false);
  const auto report = [&](EventKind kind, const Body& first, const Body& second, double p, double q) {
    outcome.events.push_back({0, kind, first.id, second.id, 0.0, p, q});
  };
  for (std::size_t i = 0; i < outcome.bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < outcome.bodies.size() && !gone[i]; ++j) {
      Body& first = outcome.bodies[i];
      Body& second = outcome.bodies[j];
      const ContactRule* rule = ruleOf(rules, first, second);
      if (rule == nullptr || gone[j]) continue;
      const auto contact = findContact(first, second);
      if (!contact) continue;
      if (rule->response == Response::Bounce || rule->response == Response::Slide) {
        if (responds(*rule, *contact, first, second)) {
          report(EventKind::Collide, first, second, contact->distance, closingSpeed(*contact, first, second));
          respond(*rule, *contact, first, second);
        }
        if (rule->separate) separate(*contact, first, second);
        continue;
      }
      const bool removes = rule->response != Response::Report;
      report(removes ? EventKind::Hit : EventKind::Touch, first, second, contact->distance, contact->touch);
      if (removes) outcome.removed[i] = outcome.removed[j] = 1;
      if (rule->response == Response::RemoveImmediately) gone[i] = gone[j] = true;
    }
  }
}

bool sameBits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

bool sameBits(const Vec2& a, const Vec2& b) {
  return sameBits(a.x(), b.x()) && sameBits(a.y(), b.y());
}

/// The first thing that differs, or nothing.
std::string difference(const Outcome& expected, const Outcome& actual) {
  for (std::size_t i = 0; i < expected.bodies.size(); ++i) {
    const Body& a = expected.bodies[i];
    const Body& b = actual.bodies[i];
    if (!sameBits(a.position, b.position) || !sameBits(a.velocity, b.velocity)) {
      return "body " + std::to_string(i) + " at " + std::to_string(b.position.x()) + ", " +
             std::to_string(b.position.y()) + " instead of " + std::to_string(a.position.x()) + ", " +
             std::to_string(a.position.y());
    }
    if (expected.removed[i] != actual.removed[i]) return "whether body " + std::to_string(i) + " is removed";
  }
  for (std::size_t i = 0; i < std::min(expected.events.size(), actual.events.size()); ++i) {
    const Event& a = expected.events[i];
    const Event& b = actual.events[i];
    if (a.kind != b.kind || a.first != b.first || a.second != b.second || !sameBits(a.p, b.p) ||
        !sameBits(a.q, b.q)) {
      return "event " + std::to_string(i) + " is of " + std::to_string(b.first) + " and " +
             std::to_string(b.second) + " instead of " + std::to_string(a.first) + " and " +
             std::to_string(a.second);
    }
  }
  if (expected.events.size() == actual.events.size()) return "";
  return std::to_string(actual.events.size()) + " events instead of " +
         std::to_string(expected.events.size());
}

double uniform(Random& random, double low, double high) {
  return low + random.nextDouble() * (high - low);
}

Vec2 somewhere(Random& random, double side) {
  const double x = uniform(random, 0.0, side);
  return {x, uniform(random, 0.0, side)};
}

/// From low to high, every decade as likely as the others.
double logUniform(Random& random, double low, double high) {
  return low * std::pow(high / low, random.nextDouble());
}

struct Crowd {
  const char* name;
  std::size_t count;
  int passes;
  std::function<Body(Random&)> draw;
};

void PrintTo(const Crowd& crowd, std::ostream* out) {
  *out << crowd.name;
}

Body ball(Random& random, const Vec2& centre, double radius) {
  const double vx = random.nextGaussian() * 50.0;
  return circle(centre.x(), centre.y(), radius, Vec2(vx, random.nextGaussian() * 50.0),
                random.nextInt(4) == 0 ? 3.0 : 1.0);
}

/// Tens of millions of pairs in all.
std::vector<Crowd> crowds() {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {
      {"EqualCircles", 1500, 4, [](Random& r) { return ball(r, somewhere(r, 640), 6.0); }},
      {"FiveThousand", 5000, 1, [](Random& r) { return ball(r, somewhere(r, 2000), 12.0); }},
      {"RadiiOverThreeDecades", 800, 4,
       [](Random& r) { return ball(r, somewhere(r, 3000), logUniform(r, 0.3, 300.0)); }},
      {"Clusters", 600, 4,
       [](Random& r) {
         const Vec2 centre(100.0 * r.nextInt(3), 100.0 * r.nextInt(3));
         return ball(r, centre + Vec2(r.nextGaussian(), r.nextGaussian()) * 8.0, uniform(r, 1.0, 9.0));
       }},
      {"CoincidentCentres", 400, 4, [](Random& r) { return ball(r, Vec2(r.nextInt(4), 7.0) * 20.0, 5.0); }},
      {"PointsAmongCircles", 1000, 3,
       [](Random& r) { return ball(r, somewhere(r, 300), r.nextInt(3) == 0 ? 5.0 : 0.0); }},
      {"PointsAlone", 500, 1, [](Random& r) { return ball(r, Vec2(r.nextInt(9), r.nextInt(9)), 0.0); }},
      {"FarOutside", 800, 4,
       [](Random& r) {
         const double far = std::pow(10.0, r.nextInt(18));
         return ball(r, Vec2(far, -far) + somewhere(r, 60), 4.0);
       }},
      {"RoundingScale", 600, 4, // positions at which a radius is a few units in the last place
       [](Random& r) { return ball(r, Vec2(1e16, 3e16) + somewhere(r, 200), uniform(r, 1.0, 4.0)); }},
      {"Tiny", 400, 3, [](Random& r) { return ball(r, somewhere(r, 1e-170), uniform(r, 0.0, 1e-171)); }},
      {"NanInfiniteAndHuge", 500, 3,
       [](Random& r) {
         Body body = ball(r, somewhere(r, 200), 8.0);
         const std::vector<double> strange{kNan, kInfinity, -kInfinity, 1e308, -1e300};
         const double value = strange[static_cast<std::size_t>(r.nextInt(5))];
         switch (r.nextInt(8)) {
         case 0:
           body.position.x() = value;
           break;
         case 1:
           body.position.y() = value;
           break;
         case 2:
           body.radius = std::isnan(value) ? 1e300 : std::abs(value);
           break;
         case 3:
           body.velocity.x() = value;
           break;
         default:
           break;
         }
         return body;
       }},
      {"RectanglesAndCircles", 900, 4,
       [](Random& r) {
         const Vec2 corner = somewhere(r, 600);
         if (r.nextInt(2) == 0) return ball(r, corner, uniform(r, 2.0, 9.0));
         const double width = logUniform(r, 0.5, 60.0);
         return rectangle(corner.x(), corner.y(), width, logUniform(r, 0.5, 60.0),
                          Vec2(r.nextGaussian(), r.nextGaussian()) * 30.0);
       }},
      {"LongRowsAndWalls", 700, 4,
       [](Random& r) {
         if (r.nextInt(100) == 0) return rectangle(-10.0, r.nextInt(400), 5000.0, 6.0);
         return ball(r, Vec2(uniform(r, 0.0, 5000.0), 400.0 * r.nextInt(2)), 6.0);
       }},
  };
}

class BroadphaseCrowd : public ::testing::TestWithParam<Crowd> {};

/// All responses, with and without separation, in three groups (a fourth has no rule).
std::vector<std::vector<ContactRule>> ruleSets() {
  const ContactRule bounce{.groupA = 0, .groupB = 0, .restitution = 0.9};
  ContactRule still = bounce;
  still.separate = false;
  return {{bounce},
          {still},
          {bounce,
           {.groupA = 0, .groupB = 1, .response = Response::Slide, .approachingOnly = false},
           {.groupA = 2, .groupB = 0, .response = Response::RemoveImmediately},
           {.groupA = 1, .groupB = 1, .response = Response::Report},
           {.groupA = 2, .groupB = 2, .response = Response::Remove}}};
}

TEST_P(BroadphaseCrowd, GivesTheBitsOfThePlainDoubleLoop) {
  const Crowd& crowd = GetParam();
  Random random(7);
  for (const std::vector<ContactRule>& rules : ruleSets()) {
    std::vector<Body> bodies;
    for (std::size_t i = 0; i < crowd.count; ++i) {
      bodies.push_back(crowd.draw(random));
      bodies.back().id = static_cast<std::uint32_t>(i);
      if (rules.size() > 1) bodies.back().group = static_cast<std::uint32_t>(random.nextInt(4));
      bodies.back().fixed = random.nextInt(12) == 0;
    }
    ContactSolver solver(rules);
    for (int pass = 0; pass < crowd.passes; ++pass) {
      Outcome expected = before(bodies);
      Outcome actual = expected;
      solvePlainly(rules, expected);
      solver.solve(actual.bodies, actual.removed, Event{}, actual.events);
      ASSERT_EQ(difference(expected, actual), "") << "pass " << pass << " with " << rules.size() << " rules";
      bodies.clear(); // the next pass: those that are left, moved on
      for (std::size_t i = 0; i < actual.bodies.size(); ++i) {
        if (actual.removed[i] != 0) continue;
        bodies.push_back(actual.bodies[i]);
        if (!bodies.back().fixed) bodies.back().position += bodies.back().velocity * (1.0 / 60.0);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Crowds, BroadphaseCrowd, ::testing::ValuesIn(crowds()),
                         [](const auto& crowd) { return std::string(crowd.param.name); });

TEST(Broadphase, LeavesOutThoseFarAway) {
  // 10,000 circles side by side: a query must not grow with their number.
  std::vector<Body> bodies;
  std::vector<std::uint32_t> members;
  for (std::uint32_t i = 0; i < 10000; ++i) {
    const std::uint32_t row = i / 100;
    bodies.push_back(circle(i % 100 * 10.0, row * 10.0, 4.0));
    members.push_back(i);
  }
  bodies.push_back(rectangle(0, 0, 1000, 30)); // a level of its own
  members.push_back(10000);
  Broadphase broadphase;
  broadphase.begin(bodies, members);
  std::vector<std::uint32_t> found;
  broadphase.query(bodies[5050], 0.0, found);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{5050})) << "all others are 10 px away";
  broadphase.query(bodies[5050], 3.0, found);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{4949, 4950, 4951, 5049, 5050, 5051, 5149, 5150, 5151}));
  broadphase.query(bodies[101], 0.0, found);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{101, 10000}));
  broadphase.remove(10000);
  bodies[7].position = Vec2(14.0, 10.0);
  broadphase.move(7, bodies[7]);
  broadphase.query(bodies[101], 0.0, found);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{7, 101}));
}

} // namespace
} // namespace offstage::test
