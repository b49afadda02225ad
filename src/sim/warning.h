#pragma once

#include "src/sim/body.h"
#include "src/sim/vec.h"
#include "src/sim/world_setup.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

namespace offstage {

/// A position or a velocity is infinite or no number.
struct NotFinite {
  Vec2 position = Vec2::Zero(); ///< px
  Vec2 velocity = Vec2::Zero(); ///< px/s
};

/// The bodies have more energy than anything accounts for (EnergyWatch).
struct EnergyGrowth {
  double gained = 0.0;  ///< mass·px²/s², since it was lowest
  double usual = 0.0;   ///< mass·px²/s²: what the bodies should have at most
  bool walls = false;   ///< an edge of the pane has a multiplier above 1
  bool euler = false;   ///< a body moves by explicit Euler
  bool attract = false; ///< a force pulls to a point with 1/r²
};

/// A body went through another, or through an edge of the pane, within one step (TunnelWatch).
struct Crossing {
  std::optional<std::uint32_t> other{}; ///< id of what it went through; or else
  std::optional<Side> side{};           ///< the edge that it is behind
  double way = 0.0;   ///< px: how far it moved in the step, as the other one sees it; 0 at an edge
  double width = 0.0; ///< px: how wide both are together
  double step = 0.0;  ///< s: how long the move took; with the contact solver the whole step; 0 at an edge
};

/// The step is longer than the integrator stands for a spring (spring_stability.h).
struct LongStep {
  double step = 0.0;      ///< s
  double limit = 0.0;     ///< s: up to which it stands it; 0: it never does
  double frequency = 0.0; ///< rad/s: of the body on its springs
  Integrator integrator = Integrator::SemiImplicitEuler;
};

/// Something about a run that its author will want to know. It changes nothing in the run.
struct Warning {
  std::int64_t frame = 0; ///< in which it was seen first
  double time = 0.0;      ///< s of simulated time
  std::uint32_t body = 0; ///< id
  std::uint32_t group = 0;
  std::variant<NotFinite, EnergyGrowth, Crossing, LongStep> what;
};

/// Each kind, by its number in Warning::what, is told once in a run.
inline constexpr std::size_t kWarningKinds = std::variant_size_v<decltype(Warning::what)>;

} // namespace offstage
