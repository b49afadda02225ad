#include "src/sim/broadphase.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace offstage {
namespace {

constexpr int kLowestOctave = -64;
/// Cells further out than this count as this one. Cells are only ever compared with <, so that is right.
constexpr double kFarthestCell = 1 << 30;

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

int Broadphase::octaveOf(const Body& body) {
  const double extent =
      body.shape == Shape::Circle ? 2.0 * body.radius : std::max(body.size.x(), body.size.y());
  if (!(extent < 0x1p+63)) return kOctaves;
  if (extent < 0x1p-64) return 0;
  return std::ilogb(extent) - kLowestOctave;
}

Broadphase::Cell Broadphase::cellOf(const Level& level, double x, double y) {
  // Every step of it is monotone, so a position within a range lies in a cell within the range of cells.
  const auto index = [&](double position) {
    return static_cast<std::int32_t>(
        std::clamp(std::floor(position * level.cellsPerPixel), -kFarthestCell, kFarthestCell));
  };
  return {index(x), index(y)};
}

std::uint32_t Broadphase::headOf(const Level& level, Cell cell) {
  // Neighbours in a row are neighbours in the table; the odd factor (2^32 over the golden ratio, Knuth, The
  // Art of Computer Programming, volume 3, section 6.4) spreads the rows.
  const std::uint32_t hash =
      static_cast<std::uint32_t>(cell.x) + static_cast<std::uint32_t>(cell.y) * 2654435769U;
  return level.firstHead + (hash & level.mask);
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
  levels_.clear();
  unbounded_.clear();
  std::array<std::uint32_t, kOctaves + 1> counts{};
  for (const std::uint32_t body : members) ++counts[static_cast<std::size_t>(octaveOf(bodies[body]))];
  // Points, which have no extent to choose a cell by, go with the smallest bodies that have one.
  std::size_t ofPoints = 1;
  while (ofPoints < kOctaves && counts[ofPoints] == 0) ++ofPoints;
  if (ofPoints == kOctaves)
    ofPoints = static_cast<std::size_t>(-kLowestOctave); // all are points: cells of 1 px
  counts[ofPoints] += counts[0];
  counts[0] = 0;

  std::array<std::uint32_t, kOctaves + 1> levelOf{};
  levelOf.fill(kNone);
  std::uint32_t headCount = 0;
  std::uint32_t memberCount = 0;
  for (std::size_t octave = 1; octave < kOctaves; ++octave) {
    if (counts[octave] == 0) continue;
    levelOf[octave] = static_cast<std::uint32_t>(levels_.size());
    Level level;
    level.members = counts[octave];
    if (octave + 1 < kOctaves && counts[octave + 1] > 0) { // within a factor of 4 of the smallest
      ++octave;
      levelOf[octave] = levelOf[octave - 1];
      level.members += counts[octave];
    }
    level.firstMember = memberCount;
    memberCount += level.members;
    const std::uint32_t heads = std::bit_ceil(level.members) * 2;
    level.mask = heads - 1;
    level.firstHead = headCount;
    headCount += heads;
    levels_.push_back(level);
  }
  levelOf[0] = levelOf[ofPoints];
  heads_.assign(headCount, kNone);
  byLevel_.resize(memberCount);

  for (Level& level : levels_) level.members = 0; // counted again as they come
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Body& body = bodies[members[i]];
    const auto member = static_cast<std::uint32_t>(i);
    entries_[i].level = levelOf[static_cast<std::size_t>(octaveOf(body))];
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
  entry.cell = cellOf(level, entry.x, entry.y);
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
      cellOf(levels_[entry.level], body.position.x(), body.position.y()) == entry.cell) {
    entry.x = body.position.x();
    entry.y = body.position.y();
    return;
  }
  remove(member);
  insert(member, body);
}

void Broadphase::query(const Body& body, double margin, std::vector<std::uint32_t>& found) const {
  found.clear();
  if (octaveOf(body) == kOctaves) {
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

  const Cell first = cellOf(level, low.x(), low.y());
  const Cell last = cellOf(level, high.x(), high.y());
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
