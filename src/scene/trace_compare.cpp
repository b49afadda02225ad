#include "src/scene/trace_compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace offstage {
namespace {

double valueOf(const TraceRow& row, TraceQuantity quantity) {
  switch (quantity) {
  case TraceQuantity::Time:
    return row.time;
  case TraceQuantity::X:
    return row.x;
  case TraceQuantity::Y:
    return row.y;
  case TraceQuantity::Vx:
    return row.vx;
  case TraceQuantity::Vy:
    return row.vy;
  case TraceQuantity::Radius:
    break;
  }
  return row.radius;
}

/// Which of several errors of a row is told first: what the body is, where it is, where it will be, the
/// clock.
int rankOf(TraceQuantity quantity) {
  switch (quantity) {
  case TraceQuantity::Radius:
    return 0;
  case TraceQuantity::X:
  case TraceQuantity::Y:
    return 1;
  case TraceQuantity::Vx:
  case TraceQuantity::Vy:
    return 2;
  case TraceQuantity::Time:
    break;
  }
  return 3;
}

bool isVelocity(TraceQuantity quantity) {
  return quantity == TraceQuantity::Vx || quantity == TraceQuantity::Vy;
}

double errorOf(double expected, double actual) {
  if (expected == actual || (std::isnan(expected) && std::isnan(actual))) return 0.0;
  const double error = std::abs(actual - expected);
  return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

class TraceComparer {
public:
  TraceComparer(const Trace& expected, const Trace& actual, const TraceTolerance& tolerance)
      : expected_(expected), actual_(actual), tolerance_(tolerance) {
    result_.velocityCompared = expected.hasVelocity && actual.hasVelocity;
    result_.lastFrame = {lastFrame(expected), lastFrame(actual)};
    frames_.resize(expected.frames.size());
  }

  TraceComparison compare(std::optional<TraceMatch> match) {
    const std::vector<TraceBody> expectedBodies = traceBodies(expected_);
    const std::vector<TraceBody> actualBodies = traceBodies(actual_);
    result_.bodies = {expectedBodies.size(), actualBodies.size()};
    result_.match =
        match.value_or(sameIds(expectedBodies, actualBodies) ? TraceMatch::Id : TraceMatch::Nearest);
    const std::vector<TracePair> pairs =
        matchBodies(expected_, expectedBodies, actual_, actualBodies, result_.match);
    const TraceBody none;
    for (const TracePair& pair : pairs) {
      compareBodies(pair.expected ? expectedBodies[*pair.expected] : none,
                    pair.actual ? actualBodies[*pair.actual] : none);
    }
    result_.same = result_.differing == 0 && result_.missing == 0 && result_.extra == 0;
    if (!result_.same) {
      for (const TracePair& pair : pairs) {
        compareEvents(pair.expected ? &expectedBodies[*pair.expected] : nullptr,
                      pair.actual ? &actualBodies[*pair.actual] : nullptr);
      }
    }
    takeCurves();
    return std::move(result_);
  }

private:
  struct FrameError {
    bool compared = false;
    double position = 0.0;
    double velocity = 0.0;
  };

  static std::int64_t lastFrame(const Trace& trace) {
    return trace.frames.empty() ? -1 : trace.frames.back().number;
  }

  void compareBodies(const TraceBody& expected, const TraceBody& actual);
  void compareRows(const TraceRow& expected, const TraceRow& actual);
  void notePresence(const TraceRow& row, bool inExpected);
  void compareEvents(const TraceBody* expected, const TraceBody* actual);
  void noteEvent(const TraceEvent& event, std::int64_t body, bool inExpected,
                 std::optional<std::int64_t> otherFrame);
  [[nodiscard]] double limitOf(TraceQuantity quantity) const;
  void takeCurves();

  const Trace& expected_;
  const Trace& actual_;
  TraceTolerance tolerance_;
  TraceComparison result_;
  std::vector<FrameError> frames_; ///< by index into the expected trace's frames
};

double TraceComparer::limitOf(TraceQuantity quantity) const {
  if (quantity == TraceQuantity::Time) return tolerance_.time;
  return isVelocity(quantity) ? tolerance_.velocity : tolerance_.position;
}

/// Walks through two lives side by side; one of them may be empty.
void TraceComparer::compareBodies(const TraceBody& expected, const TraceBody& actual) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < expected.rows.size() || j < actual.rows.size()) {
    const TraceRow* a = i < expected.rows.size() ? &expected_.rows[expected.rows[i]] : nullptr;
    const TraceRow* b = j < actual.rows.size() ? &actual_.rows[actual.rows[j]] : nullptr;
    if (a != nullptr && b != nullptr && a->frame == b->frame) {
      compareRows(*a, *b);
      ++i;
      ++j;
    } else if (b == nullptr || (a != nullptr && a->frame < b->frame)) {
      notePresence(*a, true);
      ++i;
    } else {
      notePresence(*b, false);
      ++j;
    }
  }
}

void TraceComparer::compareRows(const TraceRow& expected, const TraceRow& actual) {
  const auto frame = std::lower_bound(
      expected_.frames.begin(), expected_.frames.end(), expected.frame,
      [](const TraceFrame& candidate, std::int64_t number) { return candidate.number < number; });
  FrameError& curve = frames_[static_cast<std::size_t>(frame - expected_.frames.begin())];
  curve.compared = true;
  ++result_.compared;

  std::optional<TraceDeviation> told;
  for (std::size_t i = 0; i < kTraceQuantities; ++i) {
    const auto quantity = static_cast<TraceQuantity>(i);
    if (isVelocity(quantity) && !result_.velocityCompared) continue;
    const TraceDeviation deviation{expected.frame,
                                   expected.time,
                                   expected.id,
                                   actual.id,
                                   quantity,
                                   valueOf(expected, quantity),
                                   valueOf(actual, quantity),
                                   errorOf(valueOf(expected, quantity), valueOf(actual, quantity))};
    if (deviation.error == 0.0) continue;
    if (quantity != TraceQuantity::Time) {
      double& most = isVelocity(quantity) ? curve.velocity : curve.position;
      most = std::max(most, deviation.error);
    }
    auto& worst = result_.worst[i];
    if (!worst || deviation.error > worst->error ||
        (deviation.error == worst->error && deviation.frame < worst->frame))
      worst = deviation;
    if (deviation.error <= limitOf(quantity)) continue;
    if (!told ||
        std::tuple(rankOf(quantity), -deviation.error) < std::tuple(rankOf(told->quantity), -told->error))
      told = deviation;
  }
  if (!told) return;
  ++result_.differing;
  const auto& first = result_.first;
  if (!first || std::tie(told->frame, told->body) < std::tie(first->frame, first->body)) result_.first = told;
}

void TraceComparer::notePresence(const TraceRow& row, bool inExpected) {
  ++(inExpected ? result_.missing : result_.extra);
  if (row.frame > std::min(result_.lastFrame[0], result_.lastFrame[1])) return; // the other one has ended
  auto& first = result_.firstPresence;
  if (!first || row.frame < first->frame) first = TracePresence{row.frame, row.time, row.id, inExpected};
}

/// Finds the first event of each kind that the other body does not have in the same frame.
void TraceComparer::compareEvents(const TraceBody* expected, const TraceBody* actual) {
  const std::int64_t firstFrame = std::min(expected_.frames.empty() ? 0 : expected_.frames.front().number,
                                           actual_.frames.empty() ? 0 : actual_.frames.front().number);
  std::vector<TraceEvent> ofExpected;
  std::vector<TraceEvent> ofActual;
  if (expected != nullptr)
    ofExpected = traceEvents(expected_, *expected, firstFrame, !result_.velocityCompared);
  if (actual != nullptr) ofActual = traceEvents(actual_, *actual, firstFrame, !result_.velocityCompared);

  for (const TraceEventKind kind :
       {TraceEventKind::Spawn, TraceEventKind::Removal, TraceEventKind::BounceX, TraceEventKind::BounceY}) {
    // Without a partner only its coming and going is news.
    const bool isBounce = kind == TraceEventKind::BounceX || kind == TraceEventKind::BounceY;
    if (isBounce && (expected == nullptr || actual == nullptr)) continue;
    const auto isOther = [kind](const TraceEvent& event) { return event.kind != kind; };
    std::vector<TraceEvent> a = ofExpected;
    std::vector<TraceEvent> b = ofActual;
    std::erase_if(a, isOther);
    std::erase_if(b, isOther);
    const auto [left, right] = std::mismatch(
        a.begin(), a.end(), b.begin(), b.end(),
        [](const TraceEvent& one, const TraceEvent& other) { return one.frame == other.frame; });
    const bool more = left != a.end();
    const bool moreActual = right != b.end();
    if (more && (!moreActual || left->frame < right->frame)) {
      noteEvent(*left, expected->id, true, moreActual ? std::optional(right->frame) : std::nullopt);
    } else if (moreActual) {
      noteEvent(*right, actual->id, false, more ? std::optional(left->frame) : std::nullopt);
    }
  }
}

void TraceComparer::noteEvent(const TraceEvent& event, std::int64_t body, bool inExpected,
                              std::optional<std::int64_t> otherFrame) {
  // An event behind the other trace's end is not missing there; it was never reached.
  if (event.frame > result_.lastFrame[inExpected ? 1 : 0]) return;
  auto& first = result_.firstEvent;
  if (first && std::tie(first->event.frame, first->event.kind) <= std::tie(event.frame, event.kind)) return;
  first = TraceEventDifference{event, body, inExpected, otherFrame};
}

void TraceComparer::takeCurves() {
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    if (!frames_[i].compared) continue;
    result_.times.push_back(expected_.frames[i].time);
    result_.positionError.push_back(frames_[i].position);
    if (result_.velocityCompared) result_.velocityError.push_back(frames_[i].velocity);
  }
}

} // namespace

std::string_view name(TraceQuantity quantity) {
  constexpr std::array<std::string_view, kTraceQuantities> kNames{"time", "x", "y", "vx", "vy", "radius"};
  return kNames.at(static_cast<std::size_t>(quantity));
}

std::string_view unit(TraceQuantity quantity) {
  if (quantity == TraceQuantity::Time) return "s";
  return isVelocity(quantity) ? "px/s" : "px";
}

TraceComparison compareTraces(const Trace& expected, const Trace& actual, const TraceTolerance& tolerance,
                              std::optional<TraceMatch> match) {
  return TraceComparer(expected, actual, tolerance).compare(match);
}

} // namespace offstage
