#include "src/sim/swept_contacts.h"

#include "src/sim/contact.h"
#include "src/sim/walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace offstage {
namespace {

Event eventOf(const Event& stamp, EventKind kind, const Body& first, const Body* second, double p, double q) {
  Event event = stamp;
  event.kind = kind;
  event.first = first.id;
  if (second != nullptr) event.second = second->id;
  event.p = p;
  event.q = q;
  return event;
}

double reachBefore(const Body& body) {
  return body.shape == Shape::Circle ? body.radius : 0.0;
}
double reachAfter(const Body& body, int axis) {
  return body.shape == Shape::Circle ? body.radius : body.size[axis];
}

/// A share of all that is summed to a place; more than rounding can make of it.
constexpr double kRounding = 1e-9;

/// The distance at which two bodies touch, as of Contact.
double touchOf(const Body& first, const Body& second) {
  return first.radius + second.radius; // a rectangle's is 0
}

} // namespace

bool SweptContacts::Next::isBefore(const Next& other) const {
  return std::tie(time, first, second) < std::tie(other.time, other.first, other.second);
}

SweptContacts::SweptContacts(const WorldSetup& setup)
    : rules_(setup.contacts), walls_(setup.walls), pane_(setup.pane) {}

bool SweptContacts::begin(std::span<const Body> bodies) {
  fast_.clear();
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].continuous && !bodies[i].fixed) fast_.push_back(i);
  }
  if (fast_.empty()) return false;
  paths_.clear();
  for (const Body& body : bodies) paths_.push_back({body.position, Vec2::Zero(), 0.0});
  return true;
}

Body SweptContacts::at(std::span<const Body> bodies, std::uint32_t index, double time) const {
  Body body = bodies[index];
  const Path& path = paths_[index];
  body.position = path.from + path.velocity * (time - path.since);
  return body;
}

const ContactRule* SweptContacts::ruleOf(const Body& first, const Body& second) const {
  const std::uint32_t a = rules_.numberOf(first.group);
  const std::uint32_t b = rules_.numberOf(second.group);
  if (a == RuleTable::kNoRule || b == RuleTable::kNoRule) return nullptr;
  return rules_.find(a, b);
}

bool SweptContacts::mayMeet(const Body& first, const Path& path, const Body& second, const Path& other,
                            double now) const {
  const double left = length_ - now;
  for (int axis = 0; axis < 2; ++axis) {
    const double x = path.from[axis] + path.velocity[axis] * (now - path.since);
    const double y = other.from[axis] + other.velocity[axis] * (now - other.since);
    const double gap = std::max(y - reachBefore(second) - (x + reachAfter(first, axis)),
                                x - reachBefore(first) - (y + reachAfter(second, axis)));
    const double way = std::abs(other.velocity[axis] - path.velocity[axis]) * left;
    if (gap > way + kRounding * (way + std::abs(x) + std::abs(y) + std::abs(gap))) return false;
  }
  return true;
}

void SweptContacts::considerBody(std::span<const Body> bodies, std::uint32_t a, std::uint32_t b, double now,
                                 Next& next) const {
  if (a == b || gone_[b] != 0) return;
  const std::uint32_t i = std::min(a, b);
  const std::uint32_t j = std::max(a, b);
  if (!mayMeet(bodies[i], paths_[i], bodies[j], paths_[j], now)) return;
  if (ruleOf(bodies[i], bodies[j]) == nullptr) return;
  const auto impact = timeOfImpact(at(bodies, i, now), paths_[i].velocity, at(bodies, j, now),
                                   paths_[j].velocity, length_ - now);
  if (!impact) return;
  const Next found{now + impact->time, i, j, impact->normal};
  if (!found.isBefore(next)) return;
  const auto isThisPair = [&](const Next& done) { return done.first == i && done.second == j; };
  if (std::none_of(passed_.begin(), passed_.end(), isThisPair)) next = found;
}

void SweptContacts::considerWalls(std::span<const Body> bodies, std::uint32_t index, double now,
                                  Next& next) const {
  if (!walls_.clamp) return; // those that only flip have no moment of impact
  const Body body = at(bodies, index, now);
  for (std::uint32_t side = 0; side < 4; ++side) {
    if (!walls_.restitution[side]) continue;
    const int axis = side < 2 ? 0 : 1;
    const bool lower = side % 2 == 0;
    const double speed = lower ? -paths_[index].velocity[axis] : paths_[index].velocity[axis];
    const double x = body.position[axis];
    const double gap = lower ? x - reachBefore(body) : pane_[axis] - reachAfter(body, axis) - x;
    if (!(speed > 0.0 && gap >= 0.0)) continue;
    const Next found{now + gap / speed, index, static_cast<std::uint32_t>(bodies.size()) + side,
                     Vec2::Zero()};
    if (found.time <= length_ && found.isBefore(next)) next = found;
  }
}

void SweptContacts::findNext(std::span<const Body> bodies, std::size_t fast, double now) {
  const std::uint32_t index = fast_[fast];
  Next next;
  if (gone_[index] == 0 && impacts_[index] < kMostImpacts) {
    for (const std::uint32_t other : near_[fast]) considerBody(bodies, index, other, now, next);
    considerWalls(bodies, index, now, next);
  }
  nexts_[fast] = next;
}

void SweptContacts::findNear(std::span<const Body> bodies, std::uint32_t index, double now,
                             std::vector<std::uint32_t>& found) const {
  const Body end = at(bodies, index, length_);
  const double way = (end.position - at(bodies, index, now).position).cwiseAbs().maxCoeff();
  const double others = farthest_ * ((length_ - now) / length_ + kRounding);
  if (std::isfinite(way) && std::isfinite(others)) {
    broadphase_.query(end, way + others, found);
  } else {
    found = everybody_;
  }
  std::erase_if(found, [&](std::uint32_t other) {
    return !mayMeet(bodies[index], paths_[index], bodies[other], paths_[other], now);
  });
}

void SweptContacts::beginPaths(std::span<const Body> bodies, double h) {
  length_ = h;
  gone_.assign(bodies.size(), 0);
  impacts_.assign(bodies.size(), 0);
  numbers_.assign(bodies.size(), kNobody);
  passed_.clear();
  farthest_ = 0.0;
  everybody_.clear();
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    const Vec2 way = bodies[i].fixed ? Vec2::Zero() : Vec2(bodies[i].position - paths_[i].from);
    paths_[i].velocity = way / h;
    if (const double far = way.cwiseAbs().maxCoeff(); far > farthest_) farthest_ = far;
    everybody_.push_back(i);
  }
  broadphase_.begin(bodies, everybody_);
  if (near_.size() < fast_.size()) near_.resize(fast_.size());
  nexts_.resize(fast_.size());
  for (std::uint32_t k = 0; k < fast_.size(); ++k) {
    numbers_[fast_[k]] = k;
    findNear(bodies, fast_[k], 0.0, near_[k]);
    findNext(bodies, k, 0.0);
  }
}

void SweptContacts::concern(std::span<const std::uint32_t> who) {
  for (const std::uint32_t index : who) {
    if (numbers_[index] != kNobody) concerned_.push_back(numbers_[index]);
  }
}

void SweptContacts::takeNewPath(std::span<const Body> bodies, std::uint32_t index, double now) {
  findNear(bodies, index, now, around_);
  concern(around_);
  if (numbers_[index] != kNobody) near_[numbers_[index]] = around_;
  for (const std::uint32_t other : around_) {
    if (numbers_[other] == kNobody) continue;
    std::vector<std::uint32_t>& near = near_[numbers_[other]];
    const auto place = std::lower_bound(near.begin(), near.end(), index);
    if (place == near.end() || *place != index) near.insert(place, index);
  }
}

void SweptContacts::solve(std::span<Body> bodies, double h, std::span<std::uint8_t> removed,
                          const Event& stamp, std::vector<Event>& events) {
  if (!(h > 0.0 && std::isfinite(h))) return;
  beginPaths(bodies, h);
  const auto isBefore = [&](std::uint32_t a, std::uint32_t b) { return nexts_[a].isBefore(nexts_[b]); };
  soonest_.begin(fast_.size(), isBefore);
  while (true) {
    const Next impact = nexts_[soonest_.winner()];
    if (impact.first == kNobody) break;
    const bool isWall = impact.second >= bodies.size();
    const std::array<std::uint32_t, 2> both{impact.first, impact.second};
    const std::span<const std::uint32_t> met(both.data(), isWall ? 1 : 2);
    concerned_.clear();
    for (const std::uint32_t index : met) { // whose next may be one of these, as far as is known
      findNear(bodies, index, impact.time, around_);
      concern(around_);
    }
    if (isWall) {
      hitWall(bodies, impact, stamp, events);
    } else {
      meet(bodies, impact, removed, stamp, events);
    }
    for (const std::uint32_t index : met) {
      farthest_ = std::max(farthest_, paths_[index].velocity.cwiseAbs().maxCoeff() * h);
      broadphase_.move(index, at(bodies, index, h));
    }
    for (const std::uint32_t index : met) takeNewPath(bodies, index, impact.time);
    concern(met);
    std::sort(concerned_.begin(), concerned_.end());
    concerned_.erase(std::unique(concerned_.begin(), concerned_.end()), concerned_.end());
    const auto isMet = [&](std::uint32_t index) { return index == impact.first || index == impact.second; };
    for (const std::uint32_t k : concerned_) {
      if (isMet(fast_[k]) || isMet(nexts_[k].first) || isMet(nexts_[k].second)) {
        findNext(bodies, k, impact.time);
      } else if (gone_[fast_[k]] == 0 && impacts_[fast_[k]] < kMostImpacts) {
        for (const std::uint32_t index : met) considerBody(bodies, fast_[k], index, impact.time, nexts_[k]);
      }
      soonest_.playAgain(k, isBefore);
    }
  }

  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    if (impacts_[i] > 0) bodies[i].position = at(bodies, i, h).position;
  }
  for (const Next& pass : passed_) {
    const Body& first = bodies[pass.first];
    const Body& second = bodies[pass.second];
    const ContactRule* rule = ruleOf(first, second);
    if (rule->response != Response::Report || findContact(first, second))
      continue; // the contacts will report it
    const double touch = touchOf(first, second);
    events.push_back(eventOf(stamp, EventKind::Touch, first, &second, touch, touch));
  }
}

void SweptContacts::meet(std::span<Body> bodies, const Next& impact, std::span<std::uint8_t> removed,
                         const Event& stamp, std::vector<Event>& events) {
  Body& first = bodies[impact.first];
  Body& second = bodies[impact.second];
  const ContactRule& rule = *ruleOf(first, second);
  const double touch = touchOf(first, second);
  const Contact contact{impact.normal, touch, touch};
  const bool bounces = rule.response == Response::Bounce || rule.response == Response::Slide;
  if (rule.response == Response::Report || (bounces && !responds(rule, contact, first, second))) {
    passed_.push_back(impact);
    return;
  }
  for (const std::uint32_t index : {impact.first, impact.second}) {
    paths_[index] = {at(bodies, index, impact.time).position, Vec2::Zero(), impact.time};
    ++impacts_[index];
  }
  if (!bounces) {
    events.push_back(eventOf(stamp, EventKind::Hit, first, &second, touch, touch));
    for (const std::uint32_t index : {impact.first, impact.second}) removed[index] = gone_[index] = 1;
    return;
  }
  events.push_back(
      eventOf(stamp, EventKind::Collide, first, &second, touch, closingSpeed(contact, first, second)));
  respond(rule, contact, first, second);
  if (!first.fixed) paths_[impact.first].velocity = first.velocity;
  if (!second.fixed) paths_[impact.second].velocity = second.velocity;
  if (closingSpeed(contact, first, second) > 0.0) passed_.push_back(impact); // a slide drives them together
}

void SweptContacts::hitWall(std::span<Body> bodies, const Next& impact, const Event& stamp,
                            std::vector<Event>& events) {
  const std::size_t side = impact.second - bodies.size();
  const int axis = side < 2 ? 0 : 1;
  const bool lower = side % 2 == 0;
  Body& body = bodies[impact.first];
  body.position = at(bodies, impact.first, impact.time).position;
  // The edge itself has been reached, so that the walls' own rule holds as it stands; W − r + r may fall
  // short.
  double& x = body.position[axis];
  x = lower ? reachBefore(body) : pane_[axis] - reachAfter(body, axis);
  while (!lower && x + reachAfter(body, axis) < pane_[axis]) x = std::nextafter(x, pane_[axis]);
  bounceOffWalls(walls_, pane_, body, stamp, events);
  paths_[impact.first] = {body.position, body.velocity, impact.time};
  ++impacts_[impact.first];
}

} // namespace offstage
