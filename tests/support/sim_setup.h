#pragma once

#include "src/sim/world_setup.h"

namespace offstage::test {

/// A circle by its centre.
Body circle(double x, double y, double radius, const Vec2& velocity = Vec2::Zero(), double mass = 1.0);

/// A rectangle by its upper-left corner.
Body rectangle(double x, double y, double width, double height, const Vec2& velocity = Vec2::Zero());

/// Appends a force. (Not push_back in the tests themselves: g++ 12 then warns, wrongly, that members of the
/// variant's other alternatives may be uninitialized.)
void addForce(WorldSetup& setup, const Force& force);

} // namespace offstage::test
