#pragma once

#include <offstage/offstage.h>

struct Bounce : offstage::Exercise {
  offstage::GameObject ball{offstage::Vec2(320.0, 60.0), 20.0, offstage::Vec2(0.0, 0.0),
                            offstage::Vec2(0.0, 980.0)};

  void start(offstage::Stage& stage) override { stage.add(ball); }

  void frame(offstage::Stage& stage, double dt) override {
    ball.update(dt);
    if (ball.centerY() + ball.radius() >= stage.height() && ball.velocity().y() > 0) {
      ball.setCenterY(stage.height() - ball.radius());
      ball.setVelocity(offstage::Vec2(ball.velocity().x(), -ball.velocity().y() * 0.8));
    }
  }
};
