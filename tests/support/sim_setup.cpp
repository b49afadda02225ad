#include "tests/support/sim_setup.h"

namespace offstage::test {

Body circle(double x, double y, double radius, const Vec2& velocity, double mass) {
  Body body;
  body.position = Vec2(x, y);
  body.radius = radius;
  body.velocity = velocity;
  body.mass = mass;
  return body;
}

Body rectangle(double x, double y, double width, double height, const Vec2& velocity) {
  Body body;
  body.shape = Shape::Rectangle;
  body.position = Vec2(x, y);
  body.size = Vec2(width, height);
  body.velocity = velocity;
  return body;
}

void addForce(WorldSetup& setup, const Force& force) {
  setup.forces.push_back(force);
}

} // namespace offstage::test
