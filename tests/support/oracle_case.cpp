#include "tests/support/oracle_case.h"

#include "src/sim/random.h"
#include "tests/support/reference_csv.h"
#include "tests/support/sim_setup.h"

#include <array>
#include <sstream>
#include <stdexcept>

namespace offstage::test {
namespace {

/// One circle a second at a random place, as the lecture's second example adds them.
Spawner lectureSpawner() {
  Spawner spawner;
  spawner.x = IntegerNumber{640};
  spawner.y = IntegerNumber{480};
  spawner.radius = IntegerNumber{50};
  spawner.looks = {0};
  return spawner;
}

ContactRule rule(Response response) {
  ContactRule contact;
  contact.response = response;
  contact.separate = false;
  return contact;
}

void addFloor(WorldSetup& setup, double multiplier, bool clamp) {
  setup.walls.restitution[static_cast<std::size_t>(Side::Bottom)] = multiplier;
  setup.walls.clamp = clamp;
}

/// Exercise 2, step 2: random velocities, four walls; `contact` is what touching pairs do.
void makeStep2(WorldSetup& setup, const ContactRule& contact) {
  setup.walls.restitution.fill(0.9);
  setup.contacts = {contact};
  Spawner spawner = lectureSpawner();
  spawner.vx = SpreadNumber{120.0};
  spawner.vy = SpreadNumber{120.0};
  setup.spawners = {spawner};
}

/// Circles that do not overlap instead of the spawner's, drawn by rejection as the reference's Cases.set()
/// does.
void makeSet(WorldSetup& setup, std::size_t count, int smallest, int largest, double fastest) {
  setup.spawners.clear();
  Random random(setup.seed);
  while (setup.bodies.size() < count) {
    const double x = random.nextInt(640);
    const double y = random.nextInt(480);
    const double r = smallest + random.nextInt(largest - smallest + 1);
    if (x - r < 0 || x + r > 640 || y - r < 0 || y + r > 480) continue;
    bool free = true;
    for (const Body& other : setup.bodies) {
      if (length(Vec2(x, y) - other.position) < other.radius + r) free = false;
    }
    if (!free) continue;
    const double vx = (random.nextDouble() * 2.0 - 1.0) * fastest;
    const double vy = (random.nextDouble() * 2.0 - 1.0) * fastest;
    setup.bodies.push_back(circle(x, y, r, Vec2(vx, vy)));
  }
}

void makeProjectiles(WorldSetup& setup) {
  struct Shot {
    std::int64_t frame;
    double fromX, fromY, toX, toY, speed, radius;
  };
  static constexpr std::array<Shot, 9> kShots{{{1, 40, 440, 320, 120, 200, 5},
                                               {30, 40, 440, 600, 440, 300, 5},
                                               {60, 40, 440, 41, 439, 250, 4},
                                               {90, 40, 440, 600, 100, 6000, 3},
                                               {120, 40, 440, 40, 440, 200, 5},
                                               {150, 40, 440, 40, 0, 220, 5},
                                               {180, 320, 460, 470, 60, 260, 6},
                                               {195, 40, 100, 600, 100, 400, 5},
                                               {240, 40, 440, 613, 207, 173.5, 2.5}}};
  setup.groups = {"targets", "shots"};
  setup.gravity = Vec2::Zero();
  setup.bodies = {circle(320, 120, 20),
                  circle(500, 440, 15),
                  circle(400, 80, 20),
                  circle(338, 259, 4),
                  circle(560, 60, 18, Vec2(-20, 5)),
                  circle(180, 125, 20),
                  circle(600, 212, 10)};
  for (const Shot& shot : kShots) {
    Launch launch;
    launch.moments.push_back({shot.frame, 0.0});
    launch.from.point = Vec2(shot.fromX, shot.fromY);
    launch.toward.point = Vec2(shot.toX, shot.toY);
    launch.speed = shot.speed;
    launch.prototype.radius = shot.radius;
    launch.prototype.group = 1;
    launch.prototype.feelsGravity = false;
    launch.prototype.removedOutside = true;
    setup.launches.push_back(launch);
  }
  ContactRule contact = rule(Response::RemoveImmediately);
  contact.groupA = 0;
  contact.groupB = 1;
  setup.contacts = {contact};
}

void makeTriple(WorldSetup& setup, Response response) {
  addFloor(setup, 0.8, true);
  setup.contacts = {rule(response)};
  setup.bodies = {circle(300, 300, 20), circle(344, 300, 20), circle(322, 200, 20, Vec2(0, 60))};
}

} // namespace

std::filesystem::path referenceFolder() {
  return OFFSTAGE_SOURCE_DIR "/tests/reference";
}

WorldSetup oracleSetup(const std::string& name, std::int64_t seed) {
  WorldSetup setup;
  setup.seed = seed;
  const std::string key = name.substr(0, name.find('_'));
  if (key == "1") {
    setup.bodies = {circle(123.25, 57.5, 20)};
  } else if (key == "2a" || key == "2b") {
    setup.bodies = {circle(320, 440, 20)};
    addFloor(setup, 0.8, key == "2a");
  } else if (key == "2c" || key == "2d") {
    setup.gravity = Vec2(0.0, 980.0);
    setup.bodies = {circle(320, 60, 20)};
    addFloor(setup, 0.7, key == "2c");
  } else if (key == "3") {
    setup.gravity = Vec2::Zero();
    setup.spawners = {lectureSpawner()};
  } else if (key == "4a" || key == "4b" || key == "5a" || key == "5b") {
    addFloor(setup, 0.8, true);
    setup.spawners = {lectureSpawner()};
    if (key == "4b") setup.spawners[0].when = Spawner::When::AfterUpdate;
    if (key == "5b") setup.spawners[0].count = Spawner::Count::Alive;
    if (key[0] == '5') setup.contacts = {rule(Response::Remove)};
  } else if (key == "5c" || key == "5d") {
    makeTriple(setup, key == "5c" ? Response::Remove : Response::RemoveImmediately);
  } else if (key[0] == '6') {
    ContactRule contact = rule(key == "6c" || key == "6d" ? Response::Slide : Response::Bounce);
    contact.approachingOnly = key != "6b" && key != "6c";
    contact.separate = key == "6g";
    makeStep2(setup, contact);
    if (key == "6e") makeSet(setup, 16, 12, 30, 150.0);
    if (key == "6f") {
      setup.gravity = Vec2::Zero();
      setup.walls.restitution.fill(1.0);
      makeSet(setup, 8, 15, 40, 200.0);
    }
  } else if (key == "7") {
    makeProjectiles(setup);
  } else {
    throw std::invalid_argument("no such case: " + name);
  }
  return setup;
}

Clock oracleClock(const std::filesystem::path& dtFile) {
  std::istringstream in(readReferenceText(dtFile));
  std::vector<std::int64_t> durations;
  for (std::string line; std::getline(in, line);) durations.push_back(std::stoll(line));
  return Clock::recorded(durations);
}

} // namespace offstage::test
