// The lecture's first example in C++: a circle falls freely. The same motion and the same pixels as
// scenes/fall.toml.
#include <offstage/offstage.h>

using namespace offstage;

struct Fall : Exercise {
  Circle circle{123.25, 57.5, 20.0};
  double velocity = 0.0;

  Settings settings() const override { return {.title = "Free fall"}; }

  void start(Stage& stage) override { stage.add(circle); }

  void frame(Stage&, double dt) override {
    velocity = velocity + 9.8 * dt;
    circle.setCenterY(circle.centerY() + velocity * dt);
  }
};

int main(int argc, char** argv) {
  return run<Fall>(argc, argv);
}
