// Workload S with Box2D 2.4, without continuous physics.
#include "tests/bench/sim_report.h"

#include <box2d/box2d.h>
#include <memory>

namespace {

using offstage::test::WorkloadS;

class Box2dEngine {
public:
  explicit Box2dEngine(const WorkloadS& workload)
      : world_(std::make_unique<b2World>(b2Vec2(0.0F, -static_cast<float>(WorkloadS::kGravity)))) {
    world_->SetAllowSleeping(false);
    world_->SetContinuousPhysics(false);
    const auto side = static_cast<float>(workload.side);
    const float thick = 5.0F;
    const auto wall = [&](float x, float y, float halfWidth, float halfHeight) {
      b2BodyDef body;
      body.position.Set(x, y);
      b2PolygonShape box;
      box.SetAsBox(halfWidth, halfHeight);
      world_->CreateBody(&body)->CreateFixture(fixtureOf(box).get());
    };
    wall(side / 2, -thick, side / 2 + 2 * thick, thick);
    wall(side / 2, side + thick, side / 2 + 2 * thick, thick);
    wall(-thick, side / 2, thick, side / 2);
    wall(side + thick, side / 2, thick, side / 2);
    b2CircleShape circle;
    circle.m_radius = static_cast<float>(WorkloadS::kRadius);
    const auto fixture = fixtureOf(circle);
    for (const offstage::Body& of : workload.setup.bodies) {
      b2BodyDef body;
      body.type = b2_dynamicBody;
      body.position.Set(static_cast<float>(of.position.x()), side - static_cast<float>(of.position.y()));
      body.linearVelocity.Set(static_cast<float>(of.velocity.x()), -static_cast<float>(of.velocity.y()));
      bodies_.push_back(world_->CreateBody(&body));
      bodies_.back()->CreateFixture(fixture.get());
    }
  }
  void step() { world_->Step(1.0F / 60.0F, 8, 3); }
  [[nodiscard]] offstage::bench::SimState state(std::size_t i) const {
    const b2Vec2& position = bodies_[i]->GetPosition();
    const b2Vec2& velocity = bodies_[i]->GetLinearVelocity();
    return {position.x, position.y, velocity.x, velocity.y};
  }

private:
  static std::unique_ptr<b2FixtureDef> fixtureOf(const b2Shape& shape) {
    auto fixture = std::make_unique<b2FixtureDef>();
    fixture->shape = &shape;
    fixture->density = 1.0F;
    fixture->friction = 0.0F;
    fixture->restitution = static_cast<float>(WorkloadS::kRestitution);
    return fixture;
  }

  std::unique_ptr<b2World> world_;
  std::vector<b2Body*> bodies_;
};

} // namespace

int main(int argc, char** argv) {
  return offstage::bench::simMain<Box2dEngine>(argc, argv);
}
