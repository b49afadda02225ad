#include "src/sim/world.h"

#include "src/sim/birth.h"
#include "src/sim/setup_check.h"
#include "src/sim/state_hash.h"
#include "src/sim/walls.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace offstage {
namespace {

Event eventOf(const Event& stamp, EventKind kind, std::uint32_t id, const Vec2& value) {
  Event event = stamp;
  event.kind = kind;
  event.first = id;
  event.p = value.x();
  event.q = value.y();
  return event;
}

Event stampOf(const Tick& tick) {
  Event stamp;
  stamp.frame = tick.frame;
  stamp.time = tick.time;
  return stamp;
}

} // namespace

World::World(WorldSetup setup)
    : setup_(std::move(setup)),
      random_(setup_.seed),
      spawned_(setup_.spawners.size(), 0),
      alive_(setup_.spawners.size(), 0) {
  checkSetup(setup_);
  mover_ = Mover(setup_);
  std::vector<ContactRule> onePairAtATime = setup_.contacts;
  if (setup_.contactModel == ContactModel::Solver) {
    std::erase_if(onePairAtATime, [](const ContactRule& rule) { return rule.response == Response::Bounce; });
    pile_ = PileSolver(setup_);
  }
  swept_ = SweptContacts(setup_);
  contacts_ = ContactSolver(onePairAtATime);
  bodies_ = std::exchange(setup_.bodies, {});
  for (Body& body : bodies_) admit(body, time_);
}

void World::create(Body body, double time) {
  admit(body, time);
  bodies_.push_back(body);
}

void World::admit(Body& body, double time) {
  body.id = nextId_;
  mover_.add(setup_, body, time);
  if (body.spawner < alive_.size()) ++alive_[body.spawner];
  anyContinuous_ = anyContinuous_ || body.continuous;
  anyRemovedOutside_ = anyRemovedOutside_ || body.removedOutside;
  ++nextId_;
}

void World::step(const Tick& tick, StepObserver* observer) {
  if (tick.frame != frame_ + 1) {
    throw std::invalid_argument("World::step: frame " + std::to_string(tick.frame) +
                                " does not follow frame " + std::to_string(frame_));
  }
  events_.clear();
  frame_ = tick.frame;
  const double dt = setup_.stepping.dt;
  switch (setup_.stepping.form) {
  case Stepping::Form::Variable:
    advance(tick, observer);
    break;
  case Stepping::Form::Fixed:
    advance({tick.frame, static_cast<double>(++steps_) * dt, dt}, observer);
    break;
  case Stepping::Form::Clamped:
    while (tick.time - time_ > dt) advance({tick.frame, time_ + dt, dt}, observer);
    advance({tick.frame, tick.time, tick.time - time_}, observer);
    break;
  case Stepping::Form::Accumulator:
    // Counted in steps, so that no rounding of an accumulated rest adds up.
    while (static_cast<double>(steps_ + 1) * dt <= tick.time) {
      beforeStep_ = bodies_;
      advance({tick.frame, static_cast<double>(++steps_) * dt, dt}, observer);
    }
    ahead_ = std::clamp((tick.time - time_) / dt, 0.0, 1.0);
    break;
  }
}

void World::advance(const Tick& tick, StepObserver* observer) {
  launchDue(tick);
  spawnDue(Spawner::When::BeforeUpdate, tick, time_);
  if (setup_.contactModel == ContactModel::Solver) {
    pileStep(tick, observer);
  } else {
    const double h = tick.dt / setup_.substeps;
    for (int j = 0; j < setup_.substeps; ++j) {
      const double end = j + 1 == setup_.substeps ? tick.time : time_ + (j + 1) * h;
      substep(time_ + j * h, h, end, stampOf(tick), observer);
    }
  }
  time_ = tick.time;
  steppedFrame_ = tick.frame;
  spawnDue(Spawner::When::AfterUpdate, tick, time_);
}

void World::launchDue(const Tick& tick) {
  for (const Launch& launch : setup_.launches) {
    for (const Launch::Moment& moment : launch.moments) {
      if (!isDue(moment, {steppedFrame_, tick.frame, time_, tick.time})) continue;
      const Shot shot = aim(launch, moment, bodies_);
      if (!shot.velocity) {
        events_.push_back(eventOf(stampOf(tick), EventKind::NoFire, nextId_, shot.from));
        continue;
      }
      Body body = launch.prototype;
      body.position = body.shape == Shape::Circle ? shot.from : Vec2(shot.from - body.size * 0.5);
      body.velocity = *shot.velocity;
      events_.push_back(eventOf(stampOf(tick), EventKind::Fire, nextId_, body.velocity));
      create(body, time_);
    }
  }
}

void World::spawnDue(Spawner::When when, const Tick& tick, double time) {
  for (std::size_t i = 0; i < setup_.spawners.size(); ++i) {
    const Spawner& spawner = setup_.spawners[i];
    const auto index = static_cast<std::uint32_t>(i);
    std::int64_t& made = spawned_[i];
    if (spawner.when != when || (spawner.limit && made >= *spawner.limit)) continue;
    const std::int64_t count = spawner.count == Spawner::Count::Spawned ? made : alive_[i];
    if (!(std::floor(tick.time / spawner.every) > static_cast<double>(count))) continue;
    const Body body = drawBody(spawner, index, made, random_);
    ++made;
    events_.push_back(eventOf(stampOf(tick), EventKind::Spawn, nextId_, body.position));
    create(body, time);
  }
}

void World::substep(double t, double h, double end, const Event& stamp, StepObserver* observer) {
  if (observer != nullptr) observer->beforeMove(bodies_, h);
  const std::size_t before = events_.size();
  const bool sweeps = anyContinuous_ && swept_.begin(bodies_);
  mover_.begin(bodies_, t, h);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    if (body.fixed) continue;
    const Motion motion = mover_.next(bodies_, i, t, h, end);
    body.position = motion.position;
    body.velocity = motion.velocity;
    if (!body.continuous) bounceOffWalls(setup_.walls, setup_.pane, body, stamp, events_);
  }
  if (observer != nullptr) observer->afterMove(bodies_, std::span(events_).subspan(before));
  if (sweeps) sweep(h, stamp);
  removed_.assign(bodies_.size(), 0);
  contacts_.solve(bodies_, removed_, stamp, events_);
  removeGone(stamp);
}

void World::pileStep(const Tick& tick, StepObserver* observer) {
  if (observer != nullptr) observer->beforeMove(bodies_, tick.dt / setup_.substeps);
  const std::size_t before = events_.size();
  const Event stamp = stampOf(tick);
  const bool sweeps = anyContinuous_ && swept_.begin(bodies_);
  pile_.step(bodies_, mover_, time_, tick.dt, tick.time, stamp, events_);
  if (observer != nullptr) observer->afterMove(bodies_, std::span(events_).subspan(before));
  if (sweeps) sweep(tick.dt, stamp);
  if (sweeps || contacts_.hasRules()) pile_.bodiesMoved();
  if (!contacts_.hasRules() && !anyRemovedOutside_) return;
  removed_.assign(bodies_.size(), 0);
  contacts_.solve(bodies_, removed_, stamp, events_);
  removeGone(stamp);
}

void World::sweep(double h, const Event& stamp) {
  removed_.assign(bodies_.size(), 0);
  swept_.solve(bodies_, h, removed_, stamp, events_);
  for (Body& body : bodies_) { // the pane holds, whatever the sweep left undone
    if (body.continuous && !body.fixed) bounceOffWalls(setup_.walls, setup_.pane, body, stamp, events_);
  }
  removeMarked();
}

void World::removeGone(const Event& stamp) {
  for (std::size_t i = 0; anyRemovedOutside_ && i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    if (removed_[i] != 0 || !body.removedOutside || !isOutside(setup_.pane, body)) continue;
    removed_[i] = 1;
    events_.push_back(eventOf(stamp, EventKind::Leave, body.id, body.position));
  }
  removeMarked();
}

void World::removeMarked() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (removed_[i] != 0) {
      if (bodies_[i].spawner < alive_.size()) --alive_[bodies_[i].spawner];
      continue;
    }
    if (kept != i) bodies_[kept] = bodies_[i];
    ++kept;
  }
  if (kept == bodies_.size()) return;
  bodies_.resize(kept);
  pile_.keepOnly(removed_);
  mover_.keepOnly(bodies_);
}

std::span<const Body> World::shown(std::vector<Body>& blended) const {
  if (setup_.stepping.form != Stepping::Form::Accumulator) return bodies_;
  blended = bodies_;
  for (Body& body : blended) {
    const Body* before = findBody(beforeStep_, body.id);
    if (before != nullptr) body.position = before->position + (body.position - before->position) * ahead_;
  }
  return blended;
}

const Body* World::find(std::uint32_t id) const {
  return findBody(bodies_, id);
}

std::uint64_t World::stateHash() const {
  StateHash hash(time_);
  for (const Body& body : bodies_) {
    hash.add(body.id, body.shape, body.position, body.velocity, body.radius, body.size);
  }
  return hash.value();
}

} // namespace offstage
