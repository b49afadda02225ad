#pragma once

#include "src/sim/clock.h"
#include "src/sim/energy_watch.h"
#include "src/sim/spring_watch.h"
#include "src/sim/step_observer.h"
#include "src/sim/tunnel_watch.h"
#include "src/sim/warning.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace offstage {

class World;

/// The first body whose position or velocity is infinite or no number.
std::optional<Warning> findNotFinite(std::span<const Body> bodies);

/// Watches a world's run for what its author will want to know: NotFinite, EnergyGrowth, Crossing and
/// LongStep, each once, when it is seen first. Nothing of it reaches the world: a run that is watched has the
/// bits of one that is not. A copy goes on by itself, as a copy of the world does.
class Watch : private StepObserver {
public:
  /// `world` is at frame 0.
  explicit Watch(const World& world);

  /// world.step(tick), and the warnings of that frame. Always of the same world. Throws what step() throws.
  std::vector<Warning> step(World& world, const Tick& tick);

private:
  void beforeMove(std::span<const Body> bodies, double h) override;
  void afterMove(std::span<const Body> bodies, std::span<const Event> events) override;
  template <typename What>
  [[nodiscard]] bool told() const;
  void tell(const std::optional<Warning>& warning);

  SpringWatch springs_;
  TunnelWatch tunnels_;
  EnergyWatch energy_;
  std::array<bool, kWarningKinds> told_{};
  std::vector<Warning> warnings_; ///< of this frame; their frames and times are still to be filled in
};

} // namespace offstage
