#pragma once

#include "src/sim/body.h"
#include "src/sim/force.h"
#include "src/sim/integrator.h"
#include "src/sim/world_setup.h"

#include <cstddef>
#include <span>
#include <vector>

namespace offstage {

/// Whether a force acts on a body, going by its group and body filters alone.
bool actsOn(const Force& force, const Body& body);

/// The body that a force is tied to, if it is.
std::optional<std::uint32_t> anchorBody(const Force& force);

/// From a body's position (a rectangle's corner) to its centre.
inline Vec2 centre(const Body& body, const Vec2& position) {
  return body.shape == Shape::Circle ? position : Vec2(position + body.size * 0.5);
}

/// Sums what accelerates a body: gravity, then the body's own acceleration, then each force in order.
class ForceField {
public:
  ForceField() = default;
  /// Copies what it needs of the setup.
  explicit ForceField(const WorldSetup& setup);

  /// Some force is tied to a body, so that bodies depend on each other's motion.
  [[nodiscard]] bool couples() const { return couples_; }

  /// Looks up where the bodies that forces are tied to stand in `bodies` (ordered by id); before each step in
  /// which bodies came or went.
  void findAnchors(std::span<const Body> bodies);

  /// px/s², of bodies[index] at `motion` and `time` (s). `everyone` holds the motions of all bodies at that
  /// time, by index; it may be empty when the field does not couple.
  [[nodiscard]] Vec2 acceleration(std::span<const Body> bodies, std::size_t index, const Motion& motion,
                                  double time, std::span<const Motion> everyone) const;

private:
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

  Vec2 gravity_ = Vec2::Zero();
  std::vector<Force> forces_;
  std::vector<std::size_t>
      anchors_; ///< by force: index of the body it is tied to, kNowhere when there is none
  bool couples_ = false;
};

} // namespace offstage
