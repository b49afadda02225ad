#include "src/sim/tunnel_watch.h"

#include "src/sim/birth.h"
#include "src/sim/contact.h"
#include "src/sim/impact_time.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace offstage {
namespace {

/// How deep, as a share of the deepest, a pair has to overlap halfway through.
constexpr double kDepth = 0.25;
/// How far, in half widths of both together, a move must be to reach so deep and out again: a chord of a
/// circle at that depth is 2·√(1 − 0.75²) = 1.32 radii long.
constexpr double kReach = 1.3;

/// So many fast bodies are held against everybody, rather than sorted into a grid.
constexpr std::size_t kFew = 16;

/// px: half of how wide a body is where it is narrowest.
double halfWidth(const Body& body) {
  return body.shape == Shape::Circle ? body.radius : 0.5 * body.size.minCoeff();
}

Body movedBy(Body body, const Vec2& way) {
  body.position += way;
  return body;
}

} // namespace

TunnelWatch::TunnelWatch(const WorldSetup& setup)
    : rules_(setup.contacts),
      ruled_(setup.groups.size(), 0),
      walls_(setup.walls),
      pane_(setup.pane),
      closed_(std::any_of(walls_.restitution.begin(), walls_.restitution.end(),
                          [](const auto& edge) { return edge.has_value(); })),
      parts_(setup.contactModel == ContactModel::Solver ? setup.substeps : 1) {
  for (const ContactRule& rule : setup.contacts) ruled_[rule.groupA] = ruled_[rule.groupB] = 1;
}

bool TunnelWatch::takesPart(const Body& body) const {
  return ruled_[body.group] != 0 && !body.continuous;
}

bool TunnelWatch::haveRule(const Body& first, const Body& second) const {
  return rules_.find(rules_.numberOf(first.group), rules_.numberOf(second.group)) != nullptr;
}

void TunnelWatch::begin(std::span<const Body> bodies, double h) {
  if (rules_.empty()) return;
  length_ = h * parts_;
  starts_.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) starts_[i] = bodies[i].position;
}

std::optional<Warning> TunnelWatch::findPair(std::span<const Body> bodies, std::span<const Event> events) {
  if (rules_.empty()) return std::nullopt;
  // Mostly no two of all ways differ by enough.
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double narrowest = kInfinity;
  double widest = 0.0;
  Vec2 low = Vec2::Constant(kInfinity);
  Vec2 high = Vec2::Constant(-kInfinity);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!takesPart(bodies[i])) continue;
    const Vec2 way = bodies[i].position - starts_[i];
    low = low.cwiseMin(way);
    high = high.cwiseMax(way);
    const double half = halfWidth(bodies[i]);
    narrowest = std::min(narrowest, half);
    widest = std::max(widest, half);
  }
  if (!(widest > 0.0) || !(length(high - low) >= kReach * 2.0 * narrowest)) return std::nullopt;

  // Of two that cross, the faster one moves at least half of what both move.
  fast_.clear();
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    const Body& body = bodies[i];
    const Vec2 way = body.position - starts_[i];
    const double least = 0.5 * kReach * (halfWidth(body) + narrowest);
    if (dot(way, way) > least * least && takesPart(body)) fast_.push_back({way, i});
  }
  if (fast_.empty()) return std::nullopt;
  met_.assign(bodies.size(), 0);
  for (const Event& event : events) {
    for (const std::int64_t id : {event.first, event.second}) {
      const Body* body = id < 0 ? nullptr : findBody(bodies, static_cast<std::uint32_t>(id));
      if (body != nullptr) met_[static_cast<std::size_t>(body - bodies.data())] = 1;
    }
  }
  std::erase_if(fast_, [&](const Move& move) { return met_[move.index] != 0; });
  members_.clear();
  for (std::uint32_t i = 0; i < bodies.size(); ++i)
    if (met_[i] == 0 && takesPart(bodies[i])) members_.push_back(i);
  const bool few = fast_.size() <= kFew;
  if (!few) broadphase_.begin(bodies, members_);
  for (const Move& move : fast_) {
    if (few) {
      for (const std::uint32_t other : members_)
        if (auto warning = crossing(bodies, move, other)) return warning;
      continue;
    }
    broadphase_.query(bodies[move.index], 2.0 * move.way.cwiseAbs().maxCoeff(), near_);
    for (const std::uint32_t member : near_)
      if (auto warning = crossing(bodies, move, members_[member])) return warning;
  }
  return std::nullopt;
}

std::optional<Warning> TunnelWatch::crossing(std::span<const Body> bodies, const Move& move,
                                             std::uint32_t other) const {
  if (other == move.index) return std::nullopt;
  const Body& first = bodies[move.index];
  const Body& second = bodies[other];
  const Vec2 otherWay = second.position - starts_[other];
  const Vec2 way = move.way - otherWay;
  const double half = halfWidth(first) + halfWidth(second);
  if (!(half > 0.0 && length(way) >= kReach * half) || !haveRule(first, second)) return std::nullopt;

  // In shares of the move; neither time is there when the two overlap at that end of it.
  const Body firstStart = movedBy(first, -move.way);
  const Body secondStart = movedBy(second, -otherWay);
  const auto in = timeOfImpact(firstStart, move.way, secondStart, otherWay, 1.0);
  if (!in) return std::nullopt;
  const auto out = timeOfImpact(first, -move.way, second, -otherWay, 1.0);
  if (!out) return std::nullopt;
  const double middle = 0.5 * (in->time + (1.0 - out->time));
  const auto contact =
      findContact(movedBy(firstStart, move.way * middle), movedBy(secondStart, otherWay * middle));
  if (!contact || !(contact->touch - contact->distance >= kDepth * half)) return std::nullopt;
  Warning warning;
  warning.body = first.id;
  warning.group = first.group;
  warning.what = Crossing{.other = second.id, .way = length(way), .width = 2.0 * half, .step = length_};
  return warning;
}

/// Of a circle only, and only of one that is wholly inside the pane.
bool TunnelWatch::isInside(const Body& body) const {
  const Vec2& at = body.position;
  const double r = body.radius;
  return body.shape == Shape::Circle && at.x() >= r && at.y() >= r && at.x() <= pane_.x() - r &&
         at.y() <= pane_.y() - r;
}

std::optional<Side> TunnelWatch::edgePassed(const Body& body) const {
  for (std::size_t side = 0; side < walls_.restitution.size(); ++side) {
    if (!walls_.restitution[side]) continue;
    const int axis = side < 2 ? 0 : 1;
    const bool circle = body.shape == Shape::Circle;
    const double x = body.position[axis];
    const bool behind = side % 2 == 0 ? x + (circle ? body.radius : body.size[axis]) < 0.0
                                      : x - (circle ? body.radius : 0.0) > pane_[axis];
    if (behind) return static_cast<Side>(side);
  }
  return std::nullopt;
}

std::optional<Warning> TunnelWatch::findEdge(std::span<const Body> bodies) {
  if (!closed_ || bodies.empty()) return std::nullopt;
  std::optional<Warning> warning;
  nowBehind_.clear();
  for (const Body& body : bodies) {
    if (isInside(body)) continue; // as nearly all are
    const std::optional<Side> side = edgePassed(body);
    if (!side) continue;
    const auto before = std::lower_bound(behind_.begin(), behind_.end(), body.id,
                                         [](const Behind& one, std::uint32_t id) { return one.id < id; });
    const bool again = before != behind_.end() && before->id == body.id;
    const bool meant = again ? before->meant : body.id > newest_ || body.fixed;
    nowBehind_.push_back({body.id, meant});
    if (warning || !again || meant) continue;
    warning.emplace();
    warning->body = body.id;
    warning->group = body.group;
    warning->what = Crossing{.side = side, .width = 2.0 * halfWidth(body)};
  }
  behind_.swap(nowBehind_);
  newest_ = std::max(newest_, static_cast<std::int64_t>(bodies.back().id));
  return warning;
}

} // namespace offstage
