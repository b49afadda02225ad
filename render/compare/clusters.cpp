#include "render/compare/clusters.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace offstage {
namespace {

/// Set bits side by side: from begin up to but without end.
struct Run {
  int begin = 0;
  int end = 0;
  std::size_t group = 0;
};

struct Group {
  std::int64_t pixels = 0;
  PixelRect box{};
  int firstX = 0; ///< of the first row, with box.top its first pixel
};

void extend(PixelRect& box, const PixelRect& other) {
  if (box.empty()) {
    box = other;
    return;
  }
  box.left = std::min(box.left, other.left);
  box.top = std::min(box.top, other.top);
  box.right = std::max(box.right, other.right);
  box.bottom = std::max(box.bottom, other.bottom);
}

bool startsBefore(const Group& a, const Group& b) {
  return std::pair(a.box.top, a.firstX) < std::pair(b.box.top, b.firstX);
}

void readRuns(const BitPlane& plane, int y, int width, std::vector<Run>& runs) {
  runs.clear();
  const std::uint64_t* words = plane.row(y);
  // From x on, the first bit that is (or is not) set.
  const auto find = [&](int x, bool set) {
    while (x < width) {
      const auto at = static_cast<unsigned>(x);
      const std::uint64_t word = (set ? words[at / 64] : ~words[at / 64]) >> (at % 64U);
      if (word != 0) return std::min(width, x + std::countr_zero(word));
      x += 64 - static_cast<int>(at % 64U);
    }
    return width;
  };
  for (int x = find(0, true); x < width;) {
    const int end = find(x, false);
    runs.push_back({x, end, 0});
    x = find(end, true);
  }
}

/// The groups with pixels in the row before, and how they grow into the next row.
class Sweep {
public:
  void row(std::vector<Run>& runs, int y) {
    parents_.resize(groups_.size());
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
    std::size_t begin = 0;
    for (Run& run : runs) {
      while (begin < above_.size() && above_[begin].end < run.begin) ++begin;
      bool joined = false;
      // A corner touches: the run above may end at begin or start at end.
      for (std::size_t i = begin; i < above_.size() && above_[i].begin <= run.end; ++i) {
        const std::size_t group = root(above_[i].group);
        run.group = joined ? join(root(run.group), group) : group;
        joined = true;
      }
      if (!joined) {
        run.group = groups_.size();
        groups_.push_back({0, {}, run.begin});
        parents_.push_back(run.group);
      }
      Group& group = groups_[root(run.group)];
      group.pixels += run.end - run.begin;
      extend(group.box, {run.begin, y, run.end, y + 1});
    }
    keepThoseOf(runs);
  }

  Clusters finish() {
    std::vector<Run> none;
    row(none, 0);
    result_.largestBox = largest_.box;
    result_.largest = largest_.pixels;
    return result_;
  }

private:
  std::size_t root(std::size_t group) {
    while (parents_[group] != group) group = parents_[group] = parents_[parents_[group]];
    return group;
  }

  std::size_t join(std::size_t a, std::size_t b) {
    if (a == b) return a;
    if (startsBefore(groups_[b], groups_[a])) std::swap(a, b);
    groups_[a].pixels += groups_[b].pixels;
    extend(groups_[a].box, groups_[b].box);
    parents_[b] = a;
    return a;
  }

  /// Closes the groups that no run belongs to, and numbers the others anew.
  void keepThoseOf(std::vector<Run>& runs) {
    constexpr auto kClosed = static_cast<std::size_t>(-1);
    std::vector<std::size_t> renumbered(groups_.size(), kClosed);
    std::vector<Group> kept;
    for (Run& run : runs) {
      const std::size_t group = root(run.group);
      if (renumbered[group] == kClosed) {
        renumbered[group] = kept.size();
        kept.push_back(groups_[group]);
      }
      run.group = renumbered[group];
    }
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      if (parents_[i] == i && renumbered[i] == kClosed) close(groups_[i]);
    }
    groups_ = std::move(kept);
    above_.swap(runs);
  }

  void close(const Group& group) {
    ++result_.count;
    result_.pixels += group.pixels;
    extend(result_.box, group.box);
    if (group.pixels > largest_.pixels || (group.pixels == largest_.pixels && startsBefore(group, largest_)))
      largest_ = group;
  }

  std::vector<Run> above_;
  std::vector<Group> groups_;
  std::vector<std::size_t> parents_; ///< of groups_: of joined ones the group they went into
  Group largest_;
  Clusters result_;
};

} // namespace

Clusters findClusters(const BitPlane& plane, int width, int height) {
  Sweep sweep;
  std::vector<Run> runs;
  for (int y = 0; y < height; ++y) {
    readRuns(plane, y, width, runs);
    sweep.row(runs, y);
  }
  return sweep.finish();
}

} // namespace offstage
