#pragma once

#include "src/sim/body.h"
#include "src/sim/force.h"

#include <cstdint>
#include <optional>
#include <span>

namespace offstage {

class World;

/// What a probe tells of bodies. With one body: of that body, positions and velocities with the bits of
/// `trace`. With a group or all bodies: of the system that they make, as given behind the slash.
enum class Quantity : std::uint8_t {
  X,         ///< px: position as in `trace` / of the centre of mass
  Y,         ///< px, down
  Vx,        ///< px/s / of the centre of mass
  Vy,        ///< px/s
  Speed,     ///< px/s: |(vx, vy)|
  Px,        ///< mass·px/s: m·vx / summed
  Py,        ///< mass·px/s
  Momentum,  ///< mass·px/s: |(px, py)|
  Kinetic,   ///< mass·px²/s²: m·v²/2 / summed
  Potential, ///< mass·px²/s²: see potentialEnergy() / summed
  Energy,    ///< mass·px²/s²: kinetic + potential
  Count,     ///< 1 while the body lives, else 0 / living bodies
  Error,     ///< px: distance to another body's position; of one body only
  Time,      ///< s: of the frame; of no body
  Frame,     ///< the frame's number; of no body
};

/// A value of the world, with every name resolved. Its unit is `unit` of the quantity's own, counted from
/// `zero`: (value − zero)/unit, which with the defaults changes no bit.
struct Probe {
  Quantity quantity = Quantity::Time;
  std::optional<std::uint32_t> body;  ///< id; or else
  std::optional<std::uint32_t> group; ///< index into WorldSetup::groups; without both: all bodies
  std::uint32_t other = 0;            ///< Error: id of the body that it is held against
  double zero = 0.0;
  double unit = 1.0;
};

/// A frame as probes see it. It points into what it was made from, and is valid as long as that does not
/// change.
struct Snapshot {
  std::int64_t frame = 0;
  double time = 0.0;             ///< s
  std::span<const Body> bodies;  ///< the living ones, by id
  double paneHeight = 0.0;       ///< px
  Vec2 gravity = Vec2::Zero();   ///< px/s²
  std::span<const Force> forces; ///< as in WorldSetup
};

/// A world's present frame, valid until its next step.
Snapshot snapshotOf(const World& world);

/// The probe's value in a frame. NaN when there is none: the body is gone or not there yet, a centre of mass
/// without a mass. A fixed body has no momentum and no energy, for it counts as at rest, and it is left out
/// of centres of mass.
double valueOf(const Probe& probe, const Snapshot& snapshot);

/// mass·px²/s², of one body: the work that its forces do when it goes to where they have their zero.
///
///   uniform   gravity and its own acceleration, together a: m·(a.y·(H − y) − a.x·x) with (x, y) its centre
///             and H the pane's height. So under gravity alone it is m·g times the height above the pane's
///             lower edge.
///   spring    stiffness/2·(|d| − length)², zero at its length. A spring between two bodies counts once, for
///             the body that it acts on, not for the one that it is tied to.
///   attract   −strength·m/√(|d|² + softening²), zero far away.
///
/// Drag, wind and expressions have none, so with them the energy changes (Goldstein, Classical Mechanics,
/// section 1.1).
double potentialEnergy(const Body& body, const Snapshot& snapshot);

/// The part of it that one force has; 0 when it does not act on the body.
double potentialEnergy(const Force& force, const Body& body, const Snapshot& snapshot);

} // namespace offstage
