#include "src/scene/trace_events.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace offstage {
namespace {

/// A bounce's change of velocity differs from the step's before by more than this share of itself.
constexpr double kSudden = 0.5;

/// Finds the bounces of one component while its velocities come by, frame by frame.
class BounceFinder {
public:
  BounceFinder(TraceEventKind kind, std::vector<TraceEvent>& events) : kind_(kind), events_(events) {}

  void add(const TraceRow& row, double velocity) {
    if (last_) {
      const double change = velocity - *last_;
      const bool flips = (*last_ > 0.0 && velocity < 0.0) || (*last_ < 0.0 && velocity > 0.0);
      const bool sudden = !lastChange_ || std::abs(change - *lastChange_) > kSudden * std::abs(change);
      if (flips && sudden) events_.push_back({kind_, row.frame, row.time, *last_, velocity});
      lastChange_ = change;
    }
    last_ = velocity;
  }

private:
  TraceEventKind kind_;
  std::vector<TraceEvent>& events_;
  std::optional<double> last_;
  std::optional<double> lastChange_;
};

} // namespace

std::string_view name(TraceEventKind kind) {
  switch (kind) {
  case TraceEventKind::Spawn:
    return "spawn";
  case TraceEventKind::Removal:
    return "removal";
  case TraceEventKind::BounceX:
    return "bounce (vx)";
  case TraceEventKind::BounceY:
    break;
  }
  return "bounce (vy)";
}

std::vector<TraceEvent> traceEvents(const Trace& trace, const TraceBody& body, std::int64_t firstFrame,
                                    bool derived) {
  std::vector<TraceEvent> events;
  const TraceRow& first = trace.rows[body.rows.front()];
  const TraceRow& last = trace.rows[body.rows.back()];
  if (first.frame > firstFrame) events.push_back({TraceEventKind::Spawn, first.frame, first.time, 0.0, 0.0});
  const auto next =
      std::upper_bound(trace.frames.begin(), trace.frames.end(), last.frame,
                       [](std::int64_t number, const TraceFrame& frame) { return number < frame.number; });
  if (next != trace.frames.end())
    events.push_back({TraceEventKind::Removal, next->number, next->time, 0.0, 0.0});

  for (const TraceEventKind kind : {TraceEventKind::BounceX, TraceEventKind::BounceY}) {
    const bool isX = kind == TraceEventKind::BounceX;
    BounceFinder finder(kind, events);
    const TraceRow* before = nullptr;
    for (const std::size_t index : body.rows) {
      const TraceRow& row = trace.rows[index];
      if (!derived) {
        finder.add(row, isX ? row.vx : row.vy);
      } else if (before != nullptr && row.time > before->time) {
        finder.add(row, ((isX ? row.x : row.y) - (isX ? before->x : before->y)) / (row.time - before->time));
      }
      before = &row;
    }
  }
  return events;
}

} // namespace offstage
