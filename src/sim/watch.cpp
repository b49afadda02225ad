#include "src/sim/watch.h"

#include "src/sim/world.h"

#include <algorithm>
#include <utility>

namespace offstage {
namespace {

bool isFinite(const Body& body) {
  return body.position.allFinite() && body.velocity.allFinite();
}

} // namespace

std::optional<Warning> findNotFinite(std::span<const Body> bodies) {
  const auto lost = std::find_if_not(bodies.begin(), bodies.end(), isFinite);
  if (lost == bodies.end()) return std::nullopt;
  Warning warning;
  warning.body = lost->id;
  warning.group = lost->group;
  warning.what = NotFinite{lost->position, lost->velocity};
  return warning;
}

Watch::Watch(const World& world)
    : springs_(world.setup()), tunnels_(world.setup()), energy_(world.setup(), world.bodies()) {
  static_cast<void>(tunnels_.findEdge(world.bodies())); // those that start out there
  static_cast<void>(energy_.find(world));
}

template <typename What>
bool Watch::told() const {
  return told_[Warning{.what = What{}}.what.index()];
}

void Watch::tell(const std::optional<Warning>& warning) {
  if (!warning || told_[warning->what.index()]) return;
  told_[warning->what.index()] = true;
  warnings_.push_back(*warning);
}

void Watch::beforeMove(std::span<const Body> bodies, double h) {
  if (!told<LongStep>()) tell(springs_.find(bodies, h));
  if (!told<Crossing>()) tunnels_.begin(bodies, h);
}

void Watch::afterMove(std::span<const Body> bodies, std::span<const Event> events) {
  if (!told<Crossing>()) tell(tunnels_.findPair(bodies, events));
}

std::vector<Warning> Watch::step(World& world, const Tick& tick) {
  warnings_.clear();
  world.step(tick, this);
  if (!told<NotFinite>()) tell(findNotFinite(world.bodies()));
  if (!told<EnergyGrowth>()) tell(energy_.find(world));
  if (!told<Crossing>()) tell(tunnels_.findEdge(world.bodies()));
  for (Warning& warning : warnings_) {
    warning.frame = world.frame();
    warning.time = world.time();
  }
  return std::exchange(warnings_, {});
}

} // namespace offstage
