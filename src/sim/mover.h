#pragma once

#include "src/sim/body.h"
#include "src/sim/closed_form.h"
#include "src/sim/force_field.h"
#include "src/sim/integrator.h"
#include "src/sim/world_setup.h"

#include <cstdint>
#include <span>
#include <vector>

namespace offstage {

/// Computes where the bodies of a world go in one step. All forces see the states before the step. While no
/// force ties bodies together each is integrated by itself; otherwise they go through the stages of their
/// integrators together, so that each sees the others where they are at the time of its own stage: at their
/// own stage when they have the same integrator, on their closed form when they are Exact, at rest when
/// fixed, and else extrapolated by x + v·τ + (0.5·a·τ)·τ and v + a·τ, whose error is no larger than that of
/// the integrators it serves. Both ways run the same arithmetic, so a body that nothing is tied to has the
/// same bits in both.
class Mover {
public:
  Mover() = default;
  explicit Mover(const WorldSetup& setup);

  /// A new body moves from `time` (s) on. Throws Error(BadInput) when it is Exact and has no closed form.
  void add(const WorldSetup& setup, const Body& body, double time);
  /// Bodies have gone; `living` are those that are left.
  void keepOnly(std::span<const Body> living);

  /// Before a step of length h from time t: an Exact body that was moved by something else since its last
  /// step (a wall, a contact) starts a new closed form; throws Error(BadInput) when it has none from there.
  void begin(std::span<const Body> bodies, double t, double h);
  /// Where bodies[index] is at `end`, the time after that step. Not for fixed bodies. Until the next begin()
  /// it may be asked as bodies[0 … index−1] are moved; bodies[index] must still be where begin() saw it.
  [[nodiscard]] Motion next(std::span<const Body> bodies, std::size_t index, double t, double h, double end);

private:
  struct ExactMotion {
    std::uint32_t id;
    ClosedForm form;
    Motion last; ///< where its last step left it
  };

  [[nodiscard]] std::size_t exactIndex(std::uint32_t id) const; ///< into exact_; the id must be there
  void stepTogether(std::span<const Body> bodies, double t, double h);
  [[nodiscard]] Motion atStage(const Body& body, std::size_t index, Integrator method, std::size_t stage,
                               double t, double h) const;

  ForceField field_;
  std::vector<ExactMotion> exact_; ///< in order of id
  // Of stepTogether, by index into bodies; kept between steps to spare allocations.
  std::vector<Motion> start_;
  std::vector<Motion> everyone_;
  std::vector<stages::Accelerations> accelerations_;
};

} // namespace offstage
