#pragma once

#include "src/sim/body.h"
#include "src/sim/clock.h"
#include "src/sim/contact_solver.h"
#include "src/sim/event.h"
#include "src/sim/mover.h"
#include "src/sim/pile_solver.h"
#include "src/sim/random.h"
#include "src/sim/step_observer.h"
#include "src/sim/swept_contacts.h"
#include "src/sim/world_setup.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace offstage {

/// The state of a simulation and the one way to change it. A copy is an independent world that goes on with
/// the same bits. The order within a frame is the contract's: launches and spawns due → (for each substep:
/// forces → each body in creation order integrated and held to its walls → contacts over pairs i < j →
/// removals) → spawns that come after. With bodies that are continuous, what they meet on their ways comes
/// right before the contacts (SweptContacts). With ContactModel::Solver all substeps up to the contacts are
/// PileSolver's, and the contacts that are not its business and the removals follow once a frame.
class World {
public:
  /// Throws Error(BadInput) when a setup cannot be simulated, such as an `Exact` body without a closed form;
  /// the message names the body's id and the reason (see closedFormProblem()).
  explicit World(WorldSetup setup);

  /// One frame, in the steps that WorldSetup::stepping makes of it: `tick.frame` must be frame() + 1
  /// (std::invalid_argument otherwise). Throws Error(BadInput) when an `Exact` body has got into a state
  /// without a closed form, such as an orbit from which it escapes after a collision; the world is then to be
  /// given up. `observer`, if given, sees the steps.
  void step(const Tick& tick, StepObserver* observer = nullptr);

  [[nodiscard]] std::int64_t frame() const { return frame_; }
  /// s of simulated time. After a frame its tick's, but for Stepping::Form::Fixed and Accumulator.
  [[nodiscard]] double time() const { return time_; }
  /// The living bodies in order of creation. Valid until the next step.
  [[nodiscard]] std::span<const Body> bodies() const { return bodies_; }
  /// The bodies as a picture of the frame shows them. With Stepping::Form::Accumulator those that live before
  /// and after the last step are on the straight line between, as far along as time is left over: the picture
  /// lags behind by up to one step. `blended` holds them then.
  [[nodiscard]] std::span<const Body> shown(std::vector<Body>& blended) const;
  [[nodiscard]] const Body* find(std::uint32_t id) const; ///< null when it is gone (or was never there)
  /// What happened in the last frame, in order.
  [[nodiscard]] std::span<const Event> events() const { return events_; }
  /// What the world started from, but for its bodies, of which bodies() shows what has become.
  [[nodiscard]] const WorldSetup& setup() const { return setup_; }
  [[nodiscard]] std::uint64_t stateHash() const;

private:
  void advance(const Tick& tick, StepObserver* observer); ///< one step
  void create(Body body, double time);
  void admit(Body& body, double time); ///< gives the body its id and lets it move from `time` on
  void launchDue(const Tick& tick);
  void spawnDue(Spawner::When when, const Tick& tick, double time);
  void substep(double t, double h, double end, const Event& stamp,
               StepObserver* observer);                    ///< from t to `end`, by a step of length h
  void pileStep(const Tick& tick, StepObserver* observer); ///< all substeps at once, by ContactModel::Solver
  void sweep(double h, const Event& stamp);                ///< what continuous bodies meet on their ways
  void removeGone(const Event& stamp);
  void removeMarked();

  WorldSetup setup_;
  Random random_;
  Mover mover_;
  ContactSolver contacts_;
  PileSolver pile_;
  SweptContacts swept_;
  std::vector<Body> bodies_;
  std::vector<std::uint8_t>
      removed_; ///< by index into bodies_, within a step: 1 when a contact takes it away
  std::vector<std::int64_t> spawned_; ///< by spawner: bodies that it has made
  std::vector<std::int64_t> alive_;   ///< by spawner: those of them that live
  // Whether there ever was such a body: else nobody looks for them.
  bool anyContinuous_ = false;
  bool anyRemovedOutside_ = false;
  std::vector<Event> events_;
  std::uint32_t nextId_ = 0;
  std::int64_t frame_ = 0;
  double time_ = 0.0;
  std::int64_t steps_ = 0;        ///< made so far, of Stepping::Form::Fixed and Accumulator
  std::int64_t steppedFrame_ = 0; ///< in which the last step was made
  std::vector<Body> beforeStep_;  ///< of Stepping::Form::Accumulator: the bodies before the last step
  double ahead_ = 0.0;            ///< 0 … 1: time left over, in steps
};

} // namespace offstage
