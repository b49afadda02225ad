#pragma once

#include "src/sim/body.h"
#include "src/sim/event.h"
#include "src/sim/world_setup.h"

#include <vector>

namespace offstage {

/// A body's extent along one axis, from its position: position − before … position + after.
struct Reach {
  double before; ///< px
  double after;  ///< px
};
Reach reachOf(const Body& body, int axis);

/// Holds a body that has just moved to the pane's edges, left, right, top, bottom in this order; a circle
/// touches with centre ± radius, a rectangle with its sides. With k as below and, as an example,
/// the right one:
///
///   clamp      if (x + r >= W && vx > 0) { x = W − r; vx = −vx·k }
///   otherwise  if (x + r >= W) vx = −vx·k
///
/// k is the edge's multiplier times the body's restitution. A body with friction also loses speed along the
/// edge, at most its friction times what the speed across changed by.
///
/// Appends an event for each hit, with the frame and time of `stamp`.
void bounceOffWalls(const Walls& walls, const Vec2& pane, Body& body, const Event& stamp,
                    std::vector<Event>& events);

/// Whether a body is wholly outside the pane (touching its edge from outside is not).
bool isOutside(const Vec2& pane, const Body& body);

} // namespace offstage
