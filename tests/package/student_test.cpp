#include "bounce.h"

#include <offstage/testing.h>

TEST(Bounce, LooksAsItDid) {
  EXPECT_THAT(offstage::exerciseFrame<Bounce>(2.5), offstage::MatchesGolden("bounce@2.5s"));
}

TEST(Bounce, MovesByItsVelocity) {
  offstage::GameObject ball(offstage::Vec2(1.0, 2.0), 3.0, offstage::Vec2(4.0, 0.0));
  ball.update(0.5);
  EXPECT_THAT(ball.position(), offstage::IsNear(offstage::Vec2(3.0, 2.0), 1e-12));
}
