#pragma once

#include "render/stage/node.h"

namespace offstage {

/// The lecture's suggestion: a circle that has a velocity and an acceleration and moves itself.
class GameObject : public Circle {
public:
  /// A black circle with its centre at `position` (px), velocity in px/s, acceleration in px/s².
  GameObject(const Vec2& position, double radius, const Vec2& velocity = Vec2::Zero(),
             const Vec2& acceleration = Vec2::Zero());
  GameObject(const GameObject&) = default;
  GameObject& operator=(const GameObject&) = default;
  virtual ~GameObject() = default;

  /// One step of dt seconds in the lecture's order, semi-implicit Euler: v = v + a*dt, then p = p + v*dt with
  /// the new v.
  virtual void update(double dt);

  [[nodiscard]] Vec2 position() const { return center(); }
  [[nodiscard]] Vec2 velocity() const { return state().velocity; }
  [[nodiscard]] Vec2 acceleration() const { return state().acceleration; }
  void setPosition(const Vec2& position) { setCenter(position); }
  void setVelocity(const Vec2& velocity) { state().velocity = velocity; }
  void setAcceleration(const Vec2& acceleration) { state().acceleration = acceleration; }
};

} // namespace offstage
