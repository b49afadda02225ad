#pragma once

#include "src/scene/trace_match.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace offstage {

/// What a trace shows to have happened to a body, from its rows alone.
enum class TraceEventKind : std::uint8_t {
  Spawn,   ///< its first row stands in a later frame than the first of all
  Removal, ///< its last row stands in an earlier frame than the trace's last
  BounceX, ///< its vx changes sign at once
  BounceY, ///< its vy changes sign at once
};

struct TraceEvent {
  TraceEventKind kind = TraceEventKind::Spawn;
  /// A spawn: the first frame with the body. A removal: the first of the trace without it. A bounce: the
  /// first frame after it.
  std::int64_t frame = 0;
  double time = 0.0;   ///< s: of that frame
  double before = 0.0; ///< px/s: of a bounce, the component in the frame before
  double after = 0.0;  ///< px/s: … and in this one
};

/// "spawn", "removal", "bounce (vx)", "bounce (vy)".
std::string_view name(TraceEventKind kind);

/// The events of one body, spawn and removal first, then bounces frame by frame. `firstFrame`: in which
/// nothing is a spawn yet. `derived`: take velocities from differences of
/// positions, (x_k − x_(k−1))/(t_k − t_(k−1)), for traces without vx and vy. A sign that changes because the
/// motion turns smoothly, as at the top of a throw, is no bounce: there the velocity changes in this step as
/// it did in the step before. A bounce's change differs from it by more than half of itself.
std::vector<TraceEvent> traceEvents(const Trace& trace, const TraceBody& body, std::int64_t firstFrame,
                                    bool derived);

} // namespace offstage
