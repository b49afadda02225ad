// Exercise 2, step 1, in C++: circles that touch disappear. The same as scenes/exercise2_vanish.toml.
#include <array>
#include <offstage/offstage.h>
#include <vector>

using namespace offstage;

namespace {

const std::array kColors{Color::rgb(0x1f, 0x77, 0xb4), Color::rgb(0xff, 0x7f, 0x0e),
                         Color::rgb(0x2c, 0xa0, 0x2c), Color::rgb(0xd6, 0x27, 0x28),
                         Color::rgb(0x94, 0x67, 0xbd), Color::rgb(0x8c, 0x56, 0x4b),
                         Color::rgb(0xe3, 0x77, 0xc2), Color::rgb(0x17, 0xbe, 0xcf)};

bool touch(const GameObject& a, const GameObject& b) {
  return length(b.position() - a.position()) < a.radius() + b.radius();
}

} // namespace

struct Vanish : Exercise {
  std::vector<GameObject> balls;
  std::size_t spawned = 0;

  Settings settings() const override {
    return {.title = "Exercise 2, step 1: circles vanish when they collide", .duration = 20.0, .seed = 2022};
  }

  void start(Stage&) override {}

  void spawn(Stage& stage) {
    if (static_cast<std::size_t>(stage.time()) <= spawned) return;
    const int x = stage.random().nextInt(640);
    const int y = stage.random().nextInt(480);
    const int radius = stage.random().nextInt(50);
    GameObject ball(Vec2(x, y), radius, Vec2(0.0, 0.0), Vec2(0.0, 98.0));
    ball.setFill(kColors[spawned % kColors.size()]);
    stage.add(ball);
    balls.push_back(ball);
    ++spawned;
  }

  void frame(Stage& stage, double dt) override {
    spawn(stage);
    for (GameObject& ball : balls) {
      ball.update(dt);
      if (ball.centerY() + ball.radius() >= stage.height() && ball.velocity().y() > 0) {
        ball.setCenterY(stage.height() - ball.radius());
        ball.setVelocity(Vec2(ball.velocity().x(), -ball.velocity().y() * 0.8));
      }
    }
    // Every pair is tested on the same list before anything goes, so that the order of the pairs does not
    // matter.
    std::vector<bool> hit(balls.size(), false);
    for (std::size_t i = 0; i < balls.size(); ++i)
      for (std::size_t j = i + 1; j < balls.size(); ++j)
        if (touch(balls[i], balls[j])) hit[i] = hit[j] = true;
    std::vector<GameObject> left;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      if (hit[i])
        stage.remove(balls[i]);
      else
        left.push_back(balls[i]);
    }
    balls = left;
  }
};

int main(int argc, char** argv) {
  return run<Vanish>(argc, argv);
}
