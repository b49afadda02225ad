#pragma once

#include <cstdint>
#include <string_view>

namespace offstage {

/// What can happen in a step. The names (see name()) are those of the reference trajectories.
enum class EventKind : std::uint8_t {
  Spawn,  ///< p, q: position
  Fire,   ///< a launch; p, q: velocity
  NoFire, ///< a launch that could not: no direction, or its body is gone; p, q: where it would have started
  Left,   ///< a wall was hit; p: the coordinate that touched (x or y) before clamping, q: its velocity before
  Right,
  Top,
  Bottom,
  Hit, ///< two bodies touched and one rule removes them; p: distance, q: the distance at which they touch (r1
       ///< + r2)
  Collide, ///< two bodies touched and got new velocities; p: distance, q: closing speed v1n − v2n
  Touch,   ///< two bodies overlap and the rule only reports; p, q as Hit
  Leave,   ///< wholly outside the pane and removed; p, q: position
};

/// One event of a step, in the order in which they happened.
struct Event {
  std::int64_t frame = 0; ///< the frame that the step leads to
  EventKind kind = EventKind::Spawn;
  std::int64_t first = -1;  ///< body id (of a NoFire: the id that the body would have had)
  std::int64_t second = -1; ///< the other body's id, or −1
  double time = 0.0;        ///< s: of the frame
  double p = 0.0;
  double q = 0.0;
};

/// "spawn", "fire", "nofire", "left", "right", "top", "bottom", "hit", "collide", "touch", "leave".
std::string_view name(EventKind kind);

} // namespace offstage
