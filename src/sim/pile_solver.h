#pragma once

#include "src/sim/body.h"
#include "src/sim/contact.h"
#include "src/sim/contact_blocks.h"
#include "src/sim/contact_memory.h"
#include "src/sim/event.h"
#include "src/sim/integrator.h"
#include "src/sim/mover.h"
#include "src/sim/pair_grid.h"
#include "src/sim/rule_table.h"
#include "src/sim/world_setup.h"

#include <cstddef>
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
/// "soft step"; the spring is overdamped (damping ratio 10) and its frequency is a quarter of the parts'
/// rate, so that it is stable at any h.
///
/// The walls are contacts with something fixed, whose restitution is the wall's multiplier times the body's
/// and whose friction is the body's. Contacts are solved in the order in which the grid finds them, by
/// colour (contact_blocks.h); every operation is a double's, so the bits are the same everywhere.
///
/// Closing speeds below kRestingSteps times what the body's own acceleration makes of it in a step neither
/// bounce nor are reported; else a pile would never come to rest.
class PileSolver {
public:
  static constexpr double kRestingSteps = 4.0;

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

private:
  /// A contact that has friction.
  struct Rubbing {
    ContactBlocks::Place place;
    PileContact contact;
    double friction;
    double impulse;            ///< px/s, along (−ny, nx)
    std::uint32_t body, other; ///< as ContactMemory names it
  };
  /// How two bodies come to a contact.
  struct Meeting {
    double closing;     ///< px/s, at the step's start
    bool counts;        ///< it is fast enough to bounce and to be reported
    double restitution; ///< share of the closing speed that comes back
    double p;           ///< of its event
  };
  /// A contact whose meeting counts.
  struct Impact {
    ContactBlocks::Place place;
    PileContact contact;
    Meeting meeting;
    std::uint32_t body, other; ///< as ContactMemory names it
    bool isNew;                ///< did not touch in the step before
    bool touched;              ///< has had an impulse
  };

  void learnBodies(std::span<const Body> bodies);
  void gather(std::span<const Body> bodies, double h);
  void considerCircles(std::span<const Body> bodies, std::uint32_t a, std::uint32_t b, double dt);
  void considerShapes(std::span<const Body> bodies, std::uint32_t a, std::uint32_t b, double dt);
  void considerWalls(std::span<const Body> bodies, std::uint32_t slot, double dt);
  void addPair(std::span<const Body> bodies, PileContact& contact, double closing, double distance);
  void addContact(PileContact& contact, std::uint32_t body, std::uint32_t other, const Meeting& meeting,
                  double friction);
  [[nodiscard]] bool counts(double closing, std::uint32_t slot) const;

  void accelerate(std::span<Body> bodies, Mover& mover, bool first, double t, double h, double end);
  void warmStart();
  void solveAll(double h);
  void rub();
  void advance(std::span<Body> bodies, double h);
  void relaxAll(std::span<Body> bodies, double h);
  void change(const PileContact& contact, double x, double y, double speed);

  void restitute();
  void finish(std::span<Body> bodies, double h, const Event& stamp, std::vector<Event>& events);
  void holdToWalls(Body& body, std::uint32_t slot, const Event& stamp, std::vector<Event>& events) const;
  void report(std::span<const Body> bodies, const Event& stamp, std::size_t firstEvent,
              std::vector<Event>& events) const;
  void remember(std::size_t bodies);

  Vec2 gravity_ = Vec2::Zero();
  Vec2 pane_ = Vec2::Zero();
  Walls walls_;
  int substeps_ = 1;
  int iterations_ = 1;
  bool forces_ = false;
  RuleTable rules_;

  // By body, by index.
  std::vector<std::uint8_t> paired_; ///< 1: has a bounce rule
  ContactMemory memory_;
  double lastPart_ = 0.0; ///< s: the last step's h
  double warmth_ = 0.0;   ///< of the remembered impulses, what to start from: 0 … 1
  bool sizesChanged_ = true;

  // By slot, of a step; kept to spare allocations.
  PairGrid grid_;
  std::vector<SlotState> states_;     ///< the slots, the fixed outside, and nobody
  std::vector<std::uint32_t> groups_; ///< numbers in rules_, where there are several
  std::vector<double> weights_;       ///< 1/mass; of a fixed body 0
  std::vector<Vec2> gained_;          ///< px/s: what acceleration makes of a velocity in a part
  std::vector<Vec2> free_;            ///< px/s: the velocity without this part's contacts
  std::vector<std::uint32_t> active_;
  bool uniform_ = true; ///< every body moves by semi-implicit Euler and there are no forces
  bool plain_ = true;   ///< no body has a friction or a restitution of its own
  // Where uniform_ is false:
  std::vector<Motion> motions_; ///< where the integrators would take the bodies without contacts
  std::vector<Vec2> starts_;    ///< Body::position at the step's start

  ContactBlocks blocks_;
  std::vector<Rubbing> rubbings_;
  std::vector<Impact> impacts_;
};

} // namespace offstage
