// Exercise 1 in C++: the ball bounces and comes to rest. The same as scenes/exercise1_bounce.toml.
#include <offstage/offstage.h>

using namespace offstage;

struct Bounce : Exercise {
  GameObject ball{Vec2(320.0, 60.0), 20.0, Vec2(0.0, 0.0), Vec2(0.0, 980.0)};

  Settings settings() const override { return {.title = "Exercise 1: a bouncing ball"}; }

  void start(Stage& stage) override { stage.add(ball); }

  void frame(Stage& stage, double dt) override {
    ball.update(dt);
    if (ball.centerY() + ball.radius() >= stage.height() && ball.velocity().y() > 0) {
      ball.setCenterY(stage.height() - ball.radius());
      ball.setVelocity(Vec2(ball.velocity().x(), -ball.velocity().y() * 0.8));
    }
  }
};

int main(int argc, char** argv) {
  return run<Bounce>(argc, argv);
}
