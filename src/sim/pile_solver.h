#pragma once

#include "src/sim/body.h"
#include "src/sim/event.h"
#include "src/sim/integrator.h"
#include "src/sim/mover.h"
#include "src/sim/pile_contacts.h"
#include "src/sim/pile_slots.h"
#include "src/sim/two.h"
#include "src/sim/world_setup.h"

#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// Moves the bodies of a world in which many rest on each other: `[world] contacts = "solver"`.
///
/// One step of length dt finds the pairs that touch or soon will, and takes their normals and the impulses
/// that they had in the step before. Then follow WorldSetup::substeps parts of length h, each
///
///   1. v += a·h, by each body's integrator, and the impulses of the part before once more (warm starting)
///   2. WorldSetup::iterations sweeps over all contacts that stop approaching pairs, push overlapping ones
///      apart with a soft spring, and rub (ContactBlocks::solve)
///   3. x += v·h
///   4. one sweep without the spring, which takes back the speed that the pushing gave (ContactBlocks::relax)
///
/// and at the end pairs that met with a closing speed get their restitution's share of it back, and who is
/// beyond a wall is put onto it. Source: E. Catto, "Solver2D" (2024, box2d.org), where this order is called
/// "soft step"; the spring is overdamped (damping ratio 5) and its frequency is a quarter of the parts'
/// rate, so that it is stable at any h.
///
/// Contacts are solved in the order in which the grid finds them, by colour (contact_blocks.h); every
/// operation is a double's, so the bits are the same everywhere.
class PileSolver {
public:
  PileSolver() = default;
  /// Copies what it needs of the setup. Rules other than Response::Bounce are not its business.
  explicit PileSolver(const WorldSetup& setup);

  /// One step of length dt from time t, which ends at `end`. Appends a Collide event for each pair, and a
  /// wall's for each body, that begin to touch with a closing speed; p and q are as of the lecture's
  /// contacts, but at the step's start. When dt is not positive and finite nothing moves.
  void step(std::span<Body> bodies, Mover& mover, double t, double dt, double end, const Event& stamp,
            std::vector<Event>& events);

  /// Bodies have gone since the last step. `removed`: by index, 1 for each of them.
  void keepOnly(std::span<const std::uint8_t> removed);
  /// Somebody else has moved bodies since the last step.
  void bodiesMoved() { slots_.bodiesMoved(); }

private:
  // By semi-implicit Euler and without forces, where slots_.uniform():
  void accelerateAlike(bool first);
  void advanceAlike(double h);
  // By each body's own integrator:
  void accelerate(std::span<Body> bodies, Mover& mover, bool first, double t, double h, double end);
  void advance(std::span<Body> bodies, double h);
  void showVelocities(std::span<Body> bodies);
  void finish(std::span<Body> bodies, double h, const Event& stamp, std::vector<Event>& events);
  void settle(Body& body, std::uint32_t slot, double h);
  void holdToWalls(Body& body, std::uint32_t slot, const Event& stamp, std::vector<Event>& events) const;

  Vec2 pane_ = Vec2::Zero();
  Walls walls_;
  int substeps_ = 1;
  int iterations_ = 1;
  double lastPart_ = 0.0; ///< s: the last step's h

  PileSlots slots_;
  PileContacts contacts_;
  // Of a step; kept to spare allocations.
  std::vector<std::uint32_t> active_; ///< slots that contacts, or integrators and forces, may move
  std::vector<Two> free_;       ///< by place in active_, px/s: the velocity without this part's contacts
  std::vector<Motion> motions_; ///< by slot, where the slots are not uniform(): where the integrators
                                ///< would take the bodies without contacts
};

} // namespace offstage
