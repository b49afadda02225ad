// The lecture's first example in C++: a circle falls freely. The same motion and pixels as scenes/fall.toml.
#include <offstage/offstage.h>

using namespace offstage;

struct Fall : Exercise {
  GameObject ball{Vec2(123.25, 57.5), 20.0, Vec2(0.0, 0.0), Vec2(0.0, 9.8)};

  Settings settings() const override { return {.title = "Free fall"}; }

  void start(Stage& stage) override { stage.add(ball); }

  void frame(Stage&, double dt) override { ball.update(dt); }
};

int main(int argc, char** argv) {
  return run<Fall>(argc, argv);
}
