#include "src/scene/trace_match.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <tuple>

namespace offstage {
namespace {

/// s: bodies that start further apart in time are not the same one.
constexpr double kLatestStart = 0.5;

/// Where and when a body starts, and its place in its list.
struct Start {
  std::int64_t frame = 0;
  double time = 0.0, x = 0.0, y = 0.0;
  std::size_t index = 0;
};

std::vector<Start> startsOf(const Trace& trace, const std::vector<TraceBody>& bodies) {
  std::vector<Start> starts;
  starts.reserve(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const TraceRow& row = trace.rows[bodies[i].rows.front()];
    starts.push_back({row.frame, row.time, row.x, row.y, i});
  }
  return starts;
}

/// Bodies that start in one frame, by x, so that a search for the nearest one looks only at a few.
class FrameStarts {
public:
  void add(const Start& start) { starts_.push_back(start); }
  void sort() {
    std::sort(starts_.begin(), starts_.end(), [](const Start& a, const Start& b) {
      return std::tie(a.x, a.y, a.index) < std::tie(b.x, b.y, b.index);
    });
  }

  /// The nearest that is not taken, and its distance.
  [[nodiscard]] std::pair<const Start*, double> nearest(const Start& to,
                                                        const std::vector<bool>& taken) const {
    const Start* best = nullptr;
    double least = 0.0;
    // A distance that is no number (a start at NaN) is further than any.
    const auto consider = [&](const Start& candidate) {
      if (taken[candidate.index]) return;
      double distance = std::hypot(candidate.x - to.x, candidate.y - to.y);
      if (std::isnan(distance)) distance = HUGE_VAL;
      if (best != nullptr && (distance > least || (distance == least && candidate.index > best->index)))
        return;
      best = &candidate;
      least = distance;
    };
    const auto middle = std::lower_bound(starts_.begin(), starts_.end(), to.x,
                                         [](const Start& start, double x) { return start.x < x; });
    for (auto right = middle; right != starts_.end(); ++right) {
      if (best != nullptr && right->x - to.x > least) break;
      consider(*right);
    }
    for (auto left = middle; left != starts_.begin();) {
      --left;
      if (best != nullptr && to.x - left->x > least) break;
      consider(*left);
    }
    return {best, least};
  }

private:
  std::vector<Start> starts_;
};

/// A pair that might be, the best one first.
struct Candidate {
  std::int64_t gap = 0; ///< frames
  double distance = 0.0;
  std::size_t expected = 0;
  std::size_t actual = 0;

  friend bool operator<(const Candidate& a, const Candidate& b) { // of a queue whose largest comes first
    return std::tie(a.gap, a.distance, a.expected, a.actual) >
           std::tie(b.gap, b.distance, b.expected, b.actual);
  }
};

class NearestMatcher {
public:
  NearestMatcher(const Trace& expected, const std::vector<TraceBody>& expectedBodies, const Trace& actual,
                 const std::vector<TraceBody>& actualBodies)
      : expected_(startsOf(expected, expectedBodies)), taken_(actualBodies.size(), false) {
    for (const Start& start : startsOf(actual, actualBodies)) {
      // NaN has no place in an order, so such a start stands at the far end.
      Start placed = start;
      if (std::isnan(placed.x)) placed.x = HUGE_VAL;
      frames_[start.frame].add(placed);
      times_[start.frame] = start.time;
    }
    for (auto& [frame, starts] : frames_) starts.sort();
  }

  /// By index of the expected body: the actual one's.
  std::vector<std::optional<std::size_t>> match() {
    std::vector<std::optional<std::size_t>> partners(expected_.size());
    std::priority_queue<Candidate> queue;
    const auto enqueue = [&](const Start& start) {
      if (const auto candidate = best(start)) queue.push(*candidate);
    };
    for (const Start& start : expected_) enqueue(start);
    while (!queue.empty()) {
      const Candidate candidate = queue.top();
      queue.pop();
      if (taken_[candidate.actual]) { // by a nearer one since: look again among the rest
        enqueue(expected_[candidate.expected]);
        continue;
      }
      taken_[candidate.actual] = true;
      partners[candidate.expected] = candidate.actual;
    }
    return partners;
  }

private:
  [[nodiscard]] std::optional<Candidate> best(const Start& start) const {
    std::optional<Candidate> found;
    const auto consider = [&](std::int64_t frame, const FrameStarts& starts) {
      const auto [nearest, distance] = starts.nearest(start, taken_);
      if (nearest == nullptr) return;
      const Candidate candidate{std::abs(frame - start.frame), distance, start.index, nearest->index};
      if (!found || *found < candidate) found = candidate;
    };
    const auto reachable = [&](std::int64_t frame) {
      return std::abs(times_.at(frame) - start.time) <= kLatestStart &&
             !(found && std::abs(frame - start.frame) > found->gap);
    };
    const auto middle = frames_.lower_bound(start.frame);
    for (auto later = middle; later != frames_.end() && reachable(later->first); ++later)
      consider(later->first, later->second);
    for (auto earlier = middle; earlier != frames_.begin();) {
      --earlier;
      if (!reachable(earlier->first)) break;
      consider(earlier->first, earlier->second);
    }
    return found;
  }

  std::vector<Start> expected_;
  std::vector<bool> taken_; ///< by index of the actual body
  std::map<std::int64_t, FrameStarts> frames_;
  std::map<std::int64_t, double> times_;
};

std::vector<std::optional<std::size_t>> matchById(const std::vector<TraceBody>& expected,
                                                  const std::vector<TraceBody>& actual) {
  std::vector<std::optional<std::size_t>> partners(expected.size());
  std::size_t other = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    while (other < actual.size() && actual[other].id < expected[i].id) ++other;
    if (other < actual.size() && actual[other].id == expected[i].id) partners[i] = other;
  }
  return partners;
}

} // namespace

std::vector<TraceBody> traceBodies(const Trace& trace) {
  std::map<std::int64_t, std::vector<std::size_t>> byId;
  for (std::size_t row = 0; row < trace.rows.size(); ++row) byId[trace.rows[row].id].push_back(row);
  std::vector<TraceBody> bodies;
  bodies.reserve(byId.size());
  for (auto& [id, rows] : byId) bodies.push_back({id, std::move(rows)});
  return bodies;
}

bool sameIds(const std::vector<TraceBody>& expected, const std::vector<TraceBody>& actual) {
  return std::equal(expected.begin(), expected.end(), actual.begin(), actual.end(),
                    [](const TraceBody& a, const TraceBody& b) { return a.id == b.id; });
}

std::vector<TracePair> matchBodies(const Trace& expected, const std::vector<TraceBody>& expectedBodies,
                                   const Trace& actual, const std::vector<TraceBody>& actualBodies,
                                   TraceMatch match) {
  const auto partners = match == TraceMatch::Id
                            ? matchById(expectedBodies, actualBodies)
                            : NearestMatcher(expected, expectedBodies, actual, actualBodies).match();
  std::vector<TracePair> pairs;
  std::vector<bool> taken(actualBodies.size(), false);
  for (std::size_t i = 0; i < partners.size(); ++i) {
    pairs.push_back({i, partners[i]});
    if (partners[i]) taken[*partners[i]] = true;
  }
  for (std::size_t i = 0; i < actualBodies.size(); ++i) {
    if (!taken[i]) pairs.push_back({std::nullopt, i});
  }
  return pairs;
}

} // namespace offstage
