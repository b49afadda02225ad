// Exercise 2, step 2, in C++: circles that bounce off each other and off the walls. The same as
// scenes/exercise2_bounce.toml.
#include <array>
#include <offstage/offstage.h>
#include <vector>

using namespace offstage;

namespace {

const std::array kColors{Color::rgb(0x1f, 0x77, 0xb4), Color::rgb(0xff, 0x7f, 0x0e),
                         Color::rgb(0x2c, 0xa0, 0x2c), Color::rgb(0xd6, 0x27, 0x28),
                         Color::rgb(0x94, 0x67, 0xbd), Color::rgb(0x8c, 0x56, 0x4b),
                         Color::rgb(0xe3, 0x77, 0xc2), Color::rgb(0x17, 0xbe, 0xcf)};

constexpr double kWall = 0.9;

void holdToWalls(GameObject& ball, double width, double height) {
  const double r = ball.radius();
  if (ball.centerX() - r <= 0 && ball.velocity().x() < 0) {
    ball.setCenterX(r);
    ball.setVelocity(Vec2(-ball.velocity().x() * kWall, ball.velocity().y()));
  }
  if (ball.centerX() + r >= width && ball.velocity().x() > 0) {
    ball.setCenterX(width - r);
    ball.setVelocity(Vec2(-ball.velocity().x() * kWall, ball.velocity().y()));
  }
  if (ball.centerY() - r <= 0 && ball.velocity().y() < 0) {
    ball.setCenterY(r);
    ball.setVelocity(Vec2(ball.velocity().x(), -ball.velocity().y() * kWall));
  }
  if (ball.centerY() + r >= height && ball.velocity().y() > 0) {
    ball.setCenterY(height - r);
    ball.setVelocity(Vec2(ball.velocity().x(), -ball.velocity().y() * kWall));
  }
}

/// Equal masses exchange their velocities along the line of centres n and keep those along the tangent t;
/// overlapping circles are moved apart, half each.
void collide(GameObject& a, GameObject& b) {
  const Vec2 between = b.position() - a.position();
  const double distance = length(between);
  const double reach = a.radius() + b.radius();
  if (!(distance < reach)) return;
  const Vec2 n = distance > 0 ? Vec2(between / distance) : Vec2(1.0, 0.0);
  const Vec2 t(-n.y(), n.x());
  const double at = dot(a.velocity(), t);
  const double an = dot(a.velocity(), n);
  const double bt = dot(b.velocity(), t);
  const double bn = dot(b.velocity(), n);
  if (an > bn) {
    a.setVelocity(t * at + n * bn);
    b.setVelocity(t * bt + n * an);
  }
  const Vec2 push = n * ((reach - distance) * 0.5);
  a.setPosition(a.position() - push);
  b.setPosition(b.position() + push);
}

} // namespace

struct BounceOffEachOther : Exercise {
  std::vector<GameObject> balls;
  std::size_t spawned = 0;

  Settings settings() const override {
    return {.title = "Exercise 2, step 2", .duration = 20.0, .seed = 2022};
  }

  void start(Stage&) override {}

  void spawn(Stage& stage) {
    if (static_cast<std::size_t>(stage.time()) <= spawned) return;
    Random& random = stage.random();
    const int x = random.nextInt(640);
    const int y = random.nextInt(480);
    const int radius = random.nextInt(50);
    const double vx = (random.nextDouble() * 2.0 - 1.0) * 120.0;
    const double vy = (random.nextDouble() * 2.0 - 1.0) * 120.0;
    GameObject ball(Vec2(x, y), radius, Vec2(vx, vy), Vec2(0.0, 9.8));
    ball.setFill(kColors[spawned % kColors.size()]);
    stage.add(ball);
    balls.push_back(ball);
    ++spawned;
  }

  void frame(Stage& stage, double dt) override {
    spawn(stage);
    for (GameObject& ball : balls) {
      ball.update(dt);
      holdToWalls(ball, stage.width(), stage.height());
    }
    for (std::size_t i = 0; i < balls.size(); ++i)
      for (std::size_t j = i + 1; j < balls.size(); ++j) collide(balls[i], balls[j]);
  }
};

int main(int argc, char** argv) {
  return run<BounceOffEachOther>(argc, argv);
}
