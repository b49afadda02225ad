#pragma once

#include "src/sim/body.h"
#include "src/sim/warning.h"
#include "src/sim/world_setup.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace offstage {

/// Finds bodies whose springs are too stiff for the step. A body on springs swings with at least
///
///   frequency² = (sum of the stiffnesses of those of length 0 + the largest of the others)/mass,
///
/// or, of a spring between two bodies that both move, stiffness·(1/m1 + 1/m2) (the largest eigenvalue of the
/// stiffness matrix, each row divided by its mass, is not below any of its diagonal's entries, Rayleigh's
/// quotient; a spring with a length pulls back only along itself). Damping of springs, linear drag and wind
/// count. So what is found is too long in truth; a chain of springs may be faster still, by a factor of √2.
class SpringWatch {
public:
  SpringWatch() = default;
  /// Copies what it needs of the setup.
  explicit SpringWatch(const WorldSetup& setup);

  /// Before a step of length h (s): the first body for which it is too long. A step no longer than one that
  /// was looked at before, of the same bodies, costs nothing.
  std::optional<Warning> find(std::span<const Body> bodies, double h);

private:
  struct Swing {
    double frequency = 0.0; ///< rad/s
    double damping = 0.0;   ///< 1/s
  };
  [[nodiscard]] Swing swingOf(std::span<const Body> bodies, const Body& body) const;

  std::vector<Force> forces_; ///< springs, drags and winds; empty without a spring
  double longest_ = 0.0;      ///< s: the longest step that was looked at
  std::int64_t newest_ = -1;  ///< id of the newest body then
};

} // namespace offstage
