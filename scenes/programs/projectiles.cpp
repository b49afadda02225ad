// Projectiles in C++: constant speed towards a destination, targets drawn with image patterns. The same as
// scenes/projectiles.toml.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <offstage/offstage.h>
#include <vector>

using namespace offstage;

namespace {

ImagePattern image(const char* name) {
  ImagePattern pattern;
  pattern.file = std::filesystem::path(__FILE__).parent_path().parent_path() / "images" / name;
  return pattern;
}

/// A crate (rectangle) or the runner (circle); the crates stand still.
struct Target {
  Node node;
  std::function<bool(const GameObject&)> hitBy;
};

bool touches(const GameObject& shot, const Rectangle& crate) {
  const Vec2 nearest(std::clamp(shot.centerX(), crate.x(), crate.x() + crate.width()),
                     std::clamp(shot.centerY(), crate.y(), crate.y() + crate.height()));
  return length(shot.position() - nearest) < shot.radius();
}

} // namespace

struct Projectiles : Exercise {
  GameObject muzzle{Vec2(48.0, 428.0), 20.0};
  Rectangle nearCrate{520.0, 400.0, 48.0, 48.0, image("crate.png")};
  Rectangle topCrate{296.0, 96.0, 48.0, 48.0, image("crate.png")};
  Rectangle smallCrate{440.0, 210.0, 32.0, 32.0, image("crate.png")};
  GameObject runner{Vec2(600.0, 48.0), 26.0, Vec2(-48.0, 6.0)};
  std::vector<Target> targets;
  std::vector<GameObject> shots;
  std::size_t fired = 0;

  Settings settings() const override {
    return {.title = "Projectiles", .background = Color::rgb(0xee, 0xf4, 0xfb)};
  }

  void start(Stage& stage) override {
    ImagePattern bricks = image("bricks.png");
    bricks.anchor = {0.0, 448.0, 64.0, 32.0};
    bricks.proportional = false;
    stage.add(Rectangle(0.0, 448.0, 640.0, 32.0, bricks));
    muzzle.setFill(Color::rgb(0x37, 0x47, 0x4f));
    stage.add(muzzle);
    for (const Rectangle& crate : {nearCrate, topCrate, smallCrate}) {
      stage.add(crate);
      targets.push_back({crate, [crate](const GameObject& shot) { return touches(shot, crate); }});
    }
    runner.setFill(image("target.png"));
    stage.add(runner);
    targets.push_back({runner, [this](const GameObject& shot) {
                         return length(shot.position() - runner.position()) < runner.radius() + shot.radius();
                       }});
  }

  void fire(Stage& stage, const Vec2& from, const Vec2& toward, double speed, const Color& color) {
    const Vec2 way = toward - from;
    const double distance = length(way);
    if (distance == 0.0) return;
    GameObject shot(from, 6.0, Vec2(way.x() / distance * speed, way.y() / distance * speed));
    shot.setFill(color);
    stage.add(shot);
    shots.push_back(shot);
  }

  static Vec2 middle(const Rectangle& crate) {
    return {crate.x() + crate.width() * 0.5, crate.y() + crate.height() * 0.5};
  }

  /// The shots that are due, in the order in which the scene file lists them for each frame.
  void fireDue(Stage& stage) {
    const Color orange = Color::rgb(0xd8, 0x43, 0x15);
    const Color blue = Color::rgb(0x15, 0x65, 0xc0);
    const auto at = [&stage](std::int64_t frame) { return stage.frame() == frame; };
    if (at(30) && stage.contains(topCrate)) fire(stage, muzzle.position(), middle(topCrate), 240.0, orange);
    if ((at(60) || at(180)) && stage.contains(runner))
      fire(stage, muzzle.position(), runner.position(), 260.0, blue);
    if (at(120)) fire(stage, muzzle.position(), Vec2(49.0, 427.0), 200.0, Color::rgb(0x6a, 0x1b, 0x9a));
    if (at(240) && stage.contains(nearCrate))
      fire(stage, muzzle.position(), middle(nearCrate), 300.0, orange);
    if ((at(300) || at(360) || at(420)) && stage.contains(runner))
      fire(stage, muzzle.position(), runner.position(), 420.0, blue);
    if (at(270) && stage.contains(smallCrate))
      fire(stage, Vec2(320.0, 420.0), middle(smallCrate), 200.0, Color::rgb(0x2e, 0x7d, 0x32));
  }

  void frame(Stage& stage, double dt) override {
    fireDue(stage);
    runner.update(dt);
    for (GameObject& shot : shots) shot.update(dt);

    const auto goes = [this, &stage](GameObject& shot) {
      const auto target = std::ranges::find_if(targets, [&shot](const Target& t) { return t.hitBy(shot); });
      const double r = shot.radius();
      const bool hit = target != targets.end();
      const bool outside = shot.centerX() + r < 0 || shot.centerX() - r > stage.width() ||
                           shot.centerY() + r < 0 || shot.centerY() - r > stage.height();
      if (hit) {
        stage.remove(target->node);
        targets.erase(target);
      }
      if (hit || outside) stage.remove(shot);
      return hit || outside;
    };
    std::erase_if(shots, goes);
  }
};

int main(int argc, char** argv) {
  return run<Projectiles>(argc, argv);
}
