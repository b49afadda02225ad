#pragma once

#include "src/scene/trace_events.h"
#include "src/scene/trace_match.h"
#include "src/scene/trace_reader.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace offstage {

/// By how much a number of one trace may differ from the other's, |a − b| ≤ limit. NaN equals NaN only.
struct TraceTolerance {
  double position = 0.0; ///< px: x, y and radius, each
  double velocity = 0.0; ///< px/s: vx and vy, each; they are compared when both traces have them
  double time = 0.0;     ///< s: a frame's time
};

enum class TraceQuantity : std::uint8_t { Time, X, Y, Vx, Vy, Radius };
inline constexpr std::size_t kTraceQuantities = 6;

std::string_view name(TraceQuantity quantity); ///< "time", "x", "y", "vx", "vy", "radius"
std::string_view unit(TraceQuantity quantity); ///< "s", "px", "px/s"

/// One number that differs.
struct TraceDeviation {
  std::int64_t frame = 0;
  double time = 0.0;     ///< s: of the frame in the expected trace
  std::int64_t body = 0; ///< id in the expected trace
  std::int64_t actualBody = 0;
  TraceQuantity quantity = TraceQuantity::X;
  double expected = 0.0;
  double actual = 0.0;
  double error = 0.0; ///< |actual − expected|; infinite when only one of them is a finite number
};

/// A body that one trace has in a frame and the other has not.
struct TracePresence {
  std::int64_t frame = 0;
  double time = 0.0;     ///< s
  std::int64_t body = 0; ///< id in the trace that has it
  bool inExpected = true;
};

/// The first thing that happened in one trace and not, or not in that frame, in the other.
struct TraceEventDifference {
  TraceEvent event;
  std::int64_t body = 0;  ///< id in the trace that has it
  bool inExpected = true; ///< which trace has it
  /// The same event of the other trace, later; nothing: it never happens there.
  std::optional<std::int64_t> otherFrame;
};

struct TraceComparison {
  bool same = true;
  TraceMatch match = TraceMatch::Id; ///< how the bodies were matched
  bool velocityCompared = false;
  std::int64_t compared = 0;               ///< rows that both have
  std::int64_t differing = 0;              ///< of these, rows with a number beyond the tolerance
  std::int64_t missing = 0;                ///< rows that only the expected trace has
  std::int64_t extra = 0;                  ///< rows that only the actual trace has
  std::array<std::size_t, 2> bodies{};     ///< expected, actual
  std::array<std::int64_t, 2> lastFrame{}; ///< expected, actual; −1 without rows

  /// Of the first row (by frame, then by id) that is beyond the tolerance, what tells most: its radius, or
  /// else the larger error of x and y, or else that of vx and vy, or else its time.
  std::optional<TraceDeviation> first;
  /// The first frame that both traces reach and in which a body is in one of them only.
  std::optional<TracePresence> firstPresence;
  std::optional<TraceEventDifference> firstEvent; ///< unless the traces are the same
  /// The largest error of each quantity, by TraceQuantity; nothing where all are equal.
  std::array<std::optional<TraceDeviation>, kTraceQuantities> worst;

  // Error over time, an entry for each frame that both have.
  std::vector<double> times;         ///< s
  std::vector<double> positionError; ///< px: the largest |Δx|, |Δy| or |Δradius| of the frame
  std::vector<double> velocityError; ///< px/s: the largest |Δvx| or |Δvy|; empty unless compared
};

/// Compares two traces frame by frame (by their numbers) and body by body. `match`: nothing chooses Id when
/// both have the same ids, else Nearest. Groups are not compared: they are names, not physics.
TraceComparison compareTraces(const Trace& expected, const Trace& actual, const TraceTolerance& tolerance,
                              std::optional<TraceMatch> match = std::nullopt);

/// "frame 57 (0.95 s), body 0: y is 459.2, expected 460 (off by 0.8 px)".
std::string describe(const TraceDeviation& deviation);

/// What people read of it, a line each: the first difference, the event that came first, the worst errors,
/// bodies and frames that one of them lacks, and what was compared.
std::vector<std::string> describe(const TraceComparison& comparison);

} // namespace offstage
