#include "src/sim/broadphase.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace offstage {
namespace {

/// A touching pair's positions differ by at most the sum of their reaches, up to a few roundings: of the
/// distance, of the sum of the radii (relative to the reach), of a rectangle's far side (relative to the
/// position), and squares that vanish below 1e-162. This is more than all of them.
double slack(double position, double reach) {
  return reach * 1e-12 + std::abs(position) * 1e-15 + 1e-150;
}

/// Whoever is nowhere, or infinitely far away, touches nobody.
bool isFinite(const Vec2& position) {
  return std::isfinite(position.x()) && std::isfinite(position.y());
}

} // namespace

Broadphase::Reach Broadphase::reachOf(const Body& body) {
  if (body.shape == Shape::Rectangle) return {Vec2::Zero(), body.size};
  return {Vec2(body.radius, body.radius), Vec2(body.radius, body.radius)};
}

Broadphase::Cell Broadphase::cellAt(const Level& level, const Vec2& position) {
  return {cellOf(position.x(), level.cellsPerPixel), cellOf(position.y(), level.cellsPerPixel)};
}

std::uint32_t Broadphase::headOf(const Level& level, Cell cell) {
  return level.firstHead + listOf(cell.x, cell.y, level.mask);
}

void Broadphase::begin(std::span<const Body> bodies, std::span<const std::uint32_t> members) {
  entries_.clear();
  entries_.resize(members.size());
  layOutLevels(bodies, members);
  // From last to first, so that the lists come out ascending.
  for (std::size_t i = members.size(); i-- > 0;) {
    const auto member = static_cast<std::uint32_t>(i);
    if (entries_[i].level != kNone) insert(member, bodies[members[i]]);
  }
}

void Broadphase::layOutLevels(std::span<const Body> bodies, std::span<const std::uint32_t> members) {
  sizes_.clear();
  for (const std::uint32_t body : members) sizes_.count(extentOf(bodies[body]));
  sizes_.layOut();
  levels_.clear();
  unbounded_.clear();
  std::uint32_t headCount = 0;
  std::uint32_t memberCount = 0;
  for (const std::uint32_t count : sizes_.members()) {
    Level level;
    level.firstMember = memberCount;
    memberCount += count;
    const std::uint32_t heads = std::max(32U, std::bit_ceil(count) * 2);
    level.mask = heads - 1;
    level.firstHead = headCount;
    headCount += heads;
    levels_.push_back(level);
  }
  heads_.assign(headCount, kNone);
  byLevel_.resize(memberCount);

  for (std::size_t i = 0; i < members.size(); ++i) {
    const Body& body = bodies[members[i]];
    const auto member = static_cast<std::uint32_t>(i);
    entries_[i].level = sizes_.levelOf(extentOf(body));
    if (entries_[i].level == kNone) {
      unbounded_.push_back(member);
      continue;
    }
    Level& level = levels_[entries_[i].level];
    byLevel_[level.firstMember + level.members++] = member;
    const Reach reach = reachOf(body);
    level.reach.before = level.reach.before.cwiseMax(reach.before);
    level.reach.after = level.reach.after.cwiseMax(reach.after);
  }
  for (Level& level : levels_) {
    const double extent = (level.reach.before + level.reach.after).maxCoeff();
    level.cellsPerPixel = extent > 0.0 ? 1.0 / extent : 1.0;
  }
}

void Broadphase::insert(std::uint32_t member, const Body& body) {
  if (!isFinite(body.position)) return;
  Entry& entry = entries_[member];
  const Level& level = levels_[entry.level];
  entry.x = body.position.x();
  entry.y = body.position.y();
  entry.cell = cellAt(level, body.position);
  entry.head = headOf(level, entry.cell);
  std::uint32_t& head = heads_[entry.head];
  entry.previous = kNone;
  entry.next = head;
  if (head != kNone) entries_[head].previous = member;
  head = member;
}

void Broadphase::remove(std::uint32_t member) {
  Entry& entry = entries_[member];
  if (entry.level == kNone) {
    std::erase(unbounded_, member);
    return;
  }
  if (entry.head == kNone) return;
  (entry.previous == kNone ? heads_[entry.head] : entries_[entry.previous].next) = entry.next;
  if (entry.next != kNone) entries_[entry.next].previous = entry.previous;
  entry.head = kNone;
}

void Broadphase::move(std::uint32_t member, const Body& body) {
  Entry& entry = entries_[member];
  if (entry.level == kNone) return;
  if (entry.head != kNone && isFinite(body.position) &&
      cellAt(levels_[entry.level], body.position) == entry.cell) {
    entry.x = body.position.x();
    entry.y = body.position.y();
    return;
  }
  remove(member);
  insert(member, body);
}

void Broadphase::query(const Body& body, double margin, std::vector<std::uint32_t>& found) const {
  found.clear();
  if (sizes_.levelOf(extentOf(body)) == kNone) {
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      if (entries_[i].head != kNone) found.push_back(static_cast<std::uint32_t>(i));
    }
  } else {
    for (const Level& level : levels_) queryLevel(level, body, margin, found);
  }
  found.insert(found.end(), unbounded_.begin(), unbounded_.end());
  std::sort(found.begin(), found.end());
}

void Broadphase::queryLevel(const Level& level, const Body& body, double margin,
                            std::vector<std::uint32_t>& found) const {
  const Reach own = reachOf(body);
  const Vec2& p = body.position;
  if (!isFinite(p)) return;
  Vec2 low;
  Vec2 high;
  for (int axis = 0; axis < 2; ++axis) {
    const double before = own.before[axis] + level.reach.after[axis] + margin;
    const double after = own.after[axis] + level.reach.before[axis] + margin;
    low[axis] = p[axis] - (before + slack(p[axis], before));
    high[axis] = p[axis] + (after + slack(p[axis], after));
  }
  const auto consider = [&](std::uint32_t member, const Entry& entry) {
    if (entry.x >= low.x() && entry.x <= high.x() && entry.y >= low.y() && entry.y <= high.y()) {
      found.push_back(member);
    }
  };

  const Cell first = cellAt(level, low);
  const Cell last = cellAt(level, high);
  const std::int64_t columns = std::int64_t{last.x} - first.x + 1;
  const std::int64_t rows = std::int64_t{last.y} - first.y + 1;
  if (columns * rows >= level.members) {
    for (std::uint32_t i = 0; i < level.members; ++i) {
      const std::uint32_t member = byLevel_[level.firstMember + i];
      if (entries_[member].head != kNone) consider(member, entries_[member]);
    }
    return;
  }
  for (Cell cell{0, first.y}; cell.y <= last.y; ++cell.y) {
    for (cell.x = first.x; cell.x <= last.x; ++cell.x) {
      for (std::uint32_t member = heads_[headOf(level, cell)]; member != kNone;) {
        const Entry& entry = entries_[member];
        if (entry.cell == cell) consider(member, entry); // others share the list by chance
        member = entry.next;
      }
    }
  }
}

} // namespace offstage
