// The lecture's second example in C++: every second a circle at a random place. The same as
// scenes/spawn.toml.
#include <array>
#include <offstage/offstage.h>

using namespace offstage;

namespace {

const std::array kColors{Color::rgb(0x1f, 0x77, 0xb4), Color::rgb(0xff, 0x7f, 0x0e),
                         Color::rgb(0x2c, 0xa0, 0x2c), Color::rgb(0xd6, 0x27, 0x28),
                         Color::rgb(0x94, 0x67, 0xbd), Color::rgb(0x8c, 0x56, 0x4b),
                         Color::rgb(0xe3, 0x77, 0xc2), Color::rgb(0x17, 0xbe, 0xcf)};

} // namespace

struct Spawn : Exercise {
  Settings settings() const override {
    return {.title = "A circle a second", .duration = 20.0, .seed = 2022};
  }

  void start(Stage&) override {}

  void frame(Stage& stage, double) override {
    const std::size_t count = stage.count();
    if (static_cast<std::size_t>(stage.time()) <= count) return;
    const int x = stage.random().nextInt(640);
    const int y = stage.random().nextInt(480);
    const int radius = stage.random().nextInt(50);
    Circle circle(x, y, radius, kColors[count % kColors.size()]);
    circle.setOpacity(0.85);
    stage.add(circle);
  }
};

int main(int argc, char** argv) {
  return run<Spawn>(argc, argv);
}
