#include "render/stage/game_object.h"

namespace offstage {

GameObject::GameObject(const Vec2& position, double radius, const Vec2& velocity, const Vec2& acceleration)
    : Circle(position.x(), position.y(), radius) {
  setVelocity(velocity);
  setAcceleration(acceleration);
}

void GameObject::update(double dt) {
  const Vec2 a = acceleration();
  const Vec2 v(velocity().x() + a.x() * dt, velocity().y() + a.y() * dt);
  setVelocity(v);
  setPosition(Vec2(centerX() + v.x() * dt, centerY() + v.y() * dt));
}

} // namespace offstage
