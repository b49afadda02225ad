#pragma once

#include "src/sim/event.h"
#include "src/sim/force_field.h"
#include "src/sim/probe.h"
#include "src/sim/warning.h"
#include "src/sim/world_setup.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace offstage {

class World;

/// Finds energy that comes from nowhere. Gravity, accelerations, springs and attractions keep kinetic +
/// potential energy (potentialEnergy()), contacts, walls and drag only take from it. So the sum E over
/// bodies that live in two frames may not rise from one to the other, but for the integrator's error, which
/// comes and goes; what keeps adding up is a step too long, or a rule that makes energy. With
///
///   gained  E now, minus the lowest that it has been, over all frames in which no body came or went
///   usual   the largest kinetic energy so far that was not gained, energy of stretched springs included,
///           plus, for each body, where it came to be: its pull towards points that attract it, and its
///           fall over the whole pane
///
/// a run is warned of when gained > kMost·usual: the motion is then something else than what the scene says.
/// Speeds below 1 px/s count as 1 px/s, so that nothing is made of rounding.
///
/// The slide's formula makes energy, which is what it is shown for (Response::Slide), so a frame with a
/// collision by it counts as one in which a body came. A multiplier above 1 at an edge counts as a gain.
///
/// Wind and expressions may do any work, and so may an attraction to a body that moves, which feels nothing
/// of it. Their work on a body from one frame to the next is taken as m·(a + a')/2·(x' − x), with what they
/// accelerate it by at both ends, and taken out of E; `usual` has their work over the whole pane. That is
/// rough where the way bends within a frame, so where such a force acts, kMostDriven stands for kMost.
class EnergyWatch {
public:
  static constexpr double kMost = 3.0;
  static constexpr double kMostDriven = 100.0;

  EnergyWatch() = default;
  /// `bodies`: at frame 0, where their ids are their places.
  EnergyWatch(const WorldSetup& setup, std::span<const Body> bodies);

  /// Frame 0 and then every frame, in order. The warning names the body with the most kinetic energy.
  std::optional<Warning> find(const World& world);

private:
  struct Known {
    std::uint32_t id = 0;
    double energy = 0.0; ///< in the last frame
    double bound = 0.0;  ///< its part of `usual` that stays
  };
  /// Where a body was in the last frame (px), and what forces that do work accelerated it by (px/s²).
  struct Driven {
    Vec2 position = Vec2::Zero(), acceleration = Vec2::Zero();
  };
  [[nodiscard]] bool isSlide(const World& world, const Event& event) const;
  static double boundOf(const Body& body, const Snapshot& snapshot, const Vec2& pane);

  [[nodiscard]] Vec2 drivenBy(const World& world, std::size_t index) const;

  std::vector<Force> keeping_; ///< forces that have a potential
  bool isDriven_ = false;      ///< there are others
  ForceField driving_;         ///< those
  std::vector<Motion> everyone_;
  EnergyGrowth causes_;
  std::vector<ContactRule> slides_;
  std::vector<Known> known_, now_;         ///< by id, in the last frame and in this one
  std::vector<Driven> driven_, drivenNow_; ///< the same, where isDriven_
  double sum_ = 0.0;                       ///< E, from 0 on
  double lowest_ = 0.0;
  double moving_ = 0.0; ///< the first part of `usual`
};

} // namespace offstage
