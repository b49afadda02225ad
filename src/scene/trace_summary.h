#pragma once

#include "src/sim/broadphase.h"
#include "src/sim/world.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace offstage {

/// What a run comes to: momentum, energy and its drift, contacts, the largest overlap. Units: px, s, and the
/// masses that the scene gives.
///
/// The drift is how far the energy has got from where it began, over all frames in which no body came or
/// went, as of EnergyWatch: what a body brings or takes along says nothing of the motion.
class TraceSummary {
public:
  explicit TraceSummary(const WorldSetup& setup);

  /// Every frame in order, from frame 0 on.
  void add(const World& world);

  /// Lines of text, the last one ended.
  [[nodiscard]] std::string text() const;

private:
  /// Of all bodies, as probes tell it (src/sim/probe.h).
  struct Totals {
    std::int64_t frame = 0;
    double time = 0.0;
    std::size_t bodies = 0;
    double px = 0.0, py = 0.0;             ///< mass·px/s
    double kinetic = 0.0, potential = 0.0; ///< mass·px²/s²
    [[nodiscard]] double energy() const { return kinetic + potential; }
  };
  struct Overlap {
    double depth = 0.0;  ///< px
    double radius = 0.0; ///< px: of the smaller circle; 0 with a rectangle
    std::int64_t frame = 0;
    std::uint32_t first = 0, second = 0; ///< ids
  };
  struct Drift {
    double energy = 0.0; ///< |E − unmoved_|
    std::int64_t frame = 0;
  };

  void addDrift(const Totals& before, bool sameBodies);
  void countEvents(const World& world);
  void findOverlaps(const World& world);
  [[nodiscard]] bool collide(const Body& first, const Body& second) const;

  std::vector<ContactRule> rules_;
  std::vector<std::uint8_t> ruled_; ///< by group: 1 when a rule names it
  std::optional<Totals> start_;
  Totals end_;
  double unmoved_ = 0.0;     ///< E at frame 0 and all that it changed by when bodies came or went
  std::int64_t leftOut_ = 0; ///< frames in which they did
  Drift drift_;
  std::optional<Overlap> overlap_;
  std::int64_t collisions_ = 0, hits_ = 0, touches_ = 0, walls_ = 0, made_ = 0, gone_ = 0;
  Broadphase broadphase_;
  std::vector<std::uint32_t> members_, near_;
};

} // namespace offstage
