#pragma once

#include "src/sim/vec.h"

#include <cstdint>

namespace offstage {

enum class Shape : std::uint8_t { Circle, Rectangle };

/// How a body's position and velocity go from one step to the next; src/sim/integrator.h has the formulas.
enum class Integrator : std::uint8_t { ExplicitEuler, SemiImplicitEuler, Verlet, Midpoint, Rk4, Exact };

/// What the simulation knows of one circle or axis-aligned rectangle. Rectangles do not rotate. What every
/// step reads of every body stands first and fills one cache line.
struct alignas(64) Body {
  std::uint32_t id = 0;               ///< number of the body in order of creation, from 0; never used again
  std::uint32_t group = 0;            ///< index into WorldSetup::groups
  std::uint32_t look = 0;             ///< what the drawing stage shows it as; means nothing to the simulation
  std::uint32_t spawner = kNoSpawner; ///< index of the spawner that made it
  Shape shape = Shape::Circle;
  Integrator integrator = Integrator::SemiImplicitEuler;
  bool feelsGravity = true; ///< false: the world's gravity is not added
  bool fixed = false;       ///< never moves, still collides (as if its mass were infinite and its velocity 0)
  bool removedOutside = false;      ///< goes as soon as it is wholly outside the pane
  bool continuous = false;          ///< its path is swept, so that it steps over nobody (SweptContacts)
  double radius = 0.0;              ///< px, ≥ 0; of a rectangle 0
  Vec2 position = Vec2::Zero();     ///< px: a circle's centre, a rectangle's upper-left corner
  Vec2 velocity = Vec2::Zero();     ///< px/s
  Vec2 acceleration = Vec2::Zero(); ///< px/s²: its own, added to gravity
  double restitution = 1.0; ///< 0 … 1: a pair has its rule's times the geometric mean of its bodies'
  Vec2 size = Vec2::Zero(); ///< px: a rectangle's width and height, ≥ 0; of a circle 0
  double mass = 1.0;        ///< > 0
  double friction = 0.0;    ///< ≥ 0: Coulomb's coefficient; a pair has the geometric mean of its bodies'

  static constexpr std::uint32_t kNoSpawner = 0xffffffffU;
};

} // namespace offstage
