#pragma once

#include "src/sim/vec.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <variant>

namespace offstage {

/// What a force may depend on: the state of one body at one stage of an integrator.
struct ForceState {
  Vec2 position; ///< px (a rectangle's centre, not its corner)
  Vec2 velocity; ///< px/s
  double time;   ///< s
  double mass;
};

/// Where a spring or an attraction pulls to: a fixed point, or a body (its centre).
struct Anchor {
  Vec2 point = Vec2::Zero();
  std::optional<std::uint32_t> body; ///< id; when that body is gone, the force is gone
};

/// Drag: F = −linear·v − quadratic·|v|·v.  linear in mass/s, quadratic in mass/px; both ≥ 0.
struct DragForce {
  double linear = 0.0;
  double quadratic = 0.0;
};

/// Spring (Hooke): F = −stiffness·(|d| − length)·d/|d| − damping·((v − v_anchor)·d/|d|)·d/|d| with d =
/// position − anchor. With length = 0 it is evaluated as F = −stiffness·d, the isotropic oscillator, in that
/// order of operations. A spring between two bodies acts on both: equal and opposite.
struct SpringForce {
  Anchor to;
  double stiffness = 0.0; ///< mass/s², ≥ 0
  double length = 0.0;    ///< px, ≥ 0: at rest
  double damping = 0.0;   ///< mass/s, ≥ 0
};

/// Attraction as of a heavy mass at the anchor: a = −strength·d/r³ with r² = |d|² + softening², whatever the
/// body's mass; evaluated as ((−strength)*dx)/r3, r3 = r*r*r (the oracle's order). One-sided: the anchor
/// feels nothing.
struct AttractForce {
  Anchor to;
  double strength = 0.0;  ///< px³/s² (the product G·M); negative repels
  double softening = 0.0; ///< px, ≥ 0; keeps the force finite at the centre
};

/// Wind: drag against moving air. F = coefficient·(velocity − v).
struct WindForce {
  Vec2 velocity = Vec2::Zero(); ///< px/s: of the air
  double coefficient = 0.0;     ///< mass/s, ≥ 0
};

/// Any other force (mass·px/s²), as a pure function of the state: the scene's expressions, a C++ user's
/// lambda.
struct CustomForce {
  std::function<Vec2(const ForceState&)> evaluate;
};

/// One force of the world. Every kind but AttractForce is divided by the body's mass to give an acceleration.
struct Force {
  std::variant<DragForce, SpringForce, AttractForce, WindForce, CustomForce> kind;
  std::optional<std::uint32_t> group; ///< acts on this group only
  std::optional<std::uint32_t> body;  ///< acts on the body with this id only
};

} // namespace offstage
