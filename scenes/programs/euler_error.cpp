// Euler's error in C++: explicit Euler (red) and the exact curve (blue) on the same throw. An excerpt of
// scenes/euler_error.toml: the orbit and RK4 are the scene's.
#include <offstage/offstage.h>

using namespace offstage;

struct EulerError : Exercise {
  const Vec2 start0{24.0, 440.0};
  const Vec2 velocity0{72.0, -440.0};
  const Vec2 gravity{0.0, 240.0};

  Circle euler{start0.x(), start0.y(), 7.0, Color::rgb(0xd6, 0x27, 0x28)};
  Circle exact{start0.x(), start0.y(), 11.0};
  Vec2 velocity = velocity0;

  Settings settings() const override { return {.title = "Euler's error", .fps = 30.0, .duration = 6.0}; }

  void start(Stage& stage) override {
    exact.setNoFill();
    exact.setStroke(Color::rgb(0x1f, 0x77, 0xb4));
    exact.setStrokeWidth(3.0);
    stage.add(euler);
    stage.add(exact);
  }

  void frame(Stage& stage, double dt) override {
    // Explicit Euler: the old velocity moves the circle, then the acceleration changes the velocity.
    euler.setCenter(euler.center() + velocity * dt);
    velocity = velocity + gravity * dt;

    const double t = stage.time();
    exact.setCenter(start0 + velocity0 * t + gravity * (0.5 * t * t));
  }
};

int main(int argc, char** argv) {
  return run<EulerError>(argc, argv);
}
