#include "src/sim/birth.h"

#include "src/sim/force_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

namespace offstage {
namespace {

constexpr double kSmallestMass = 1e-9;

double draw(const Number& number, Random& random) {
  struct Visitor {
    Random& random;
    double operator()(const ConstantNumber& n) const { return n.value; }
    double operator()(const IntegerNumber& n) const { return random.nextInt(n.bound); }
    double operator()(const SpreadNumber& n) const { return (random.nextDouble() * 2.0 - 1.0) * n.half; }
    double operator()(const UniformNumber& n) const { return n.low + random.nextDouble() * (n.high - n.low); }
    double operator()(const GaussianNumber& n) const { return n.mean + random.nextGaussian() * n.deviation; }
  };
  return std::visit(Visitor{random}, number);
}

/// A length: a draw below 0 becomes 0.
double drawLength(const Number& number, Random& random) {
  const double value = draw(number, random);
  return value > 0.0 ? value : 0.0;
}

std::optional<Vec2> locate(const Anchor& anchor, std::span<const Body> bodies) {
  if (!anchor.body) return anchor.point;
  const Body* body = findBody(bodies, *anchor.body);
  if (body == nullptr) return std::nullopt;
  return centre(*body, body->position);
}

} // namespace

Body drawBody(const Spawner& spawner, std::uint32_t index, std::int64_t number, Random& random) {
  Body body = spawner.prototype;
  body.spawner = index;
  body.look = spawner.looks[static_cast<std::size_t>(number) % spawner.looks.size()];
  // One statement a draw: their order is part of the contract, and that of function arguments is not fixed.
  body.position.x() = draw(spawner.x, random);
  body.position.y() = draw(spawner.y, random);
  const double radius = drawLength(spawner.radius, random);
  const double width = drawLength(spawner.width, random);
  const double height = drawLength(spawner.height, random);
  body.velocity.x() = draw(spawner.vx, random);
  body.velocity.y() = draw(spawner.vy, random);
  body.acceleration.x() = draw(spawner.ax, random);
  body.acceleration.y() = draw(spawner.ay, random);
  const double mass = draw(spawner.mass, random);
  body.mass = mass > 0.0 ? mass : kSmallestMass;
  if (spawner.restitution) body.restitution = std::clamp(draw(*spawner.restitution, random), 0.0, 1.0);
  if (spawner.friction) body.friction = drawLength(*spawner.friction, random);
  const bool circle = body.shape == Shape::Circle;
  body.radius = circle ? radius : 0.0;
  body.size = circle ? Vec2(0.0, 0.0) : Vec2(width, height);
  return body;
}

bool isDue(const Launch::Moment& moment, const StepSpan& step) {
  // A frame may have no step; its launches then wait for the next one.
  if (moment.frame) return step.frameBefore < *moment.frame && *moment.frame <= step.frame;
  return step.now >= moment.time && (step.frameBefore == 0 || step.before < moment.time);
}

Shot aim(const Launch& launch, const Launch::Moment& moment, std::span<const Body> bodies) {
  const std::optional<Vec2> from = moment.from ? moment.from : locate(launch.from, bodies);
  const std::optional<Vec2> toward = moment.toward ? moment.toward : locate(launch.toward, bodies);
  if (!from) return {launch.from.point, std::nullopt};
  if (!toward) return {*from, std::nullopt};
  const Vec2 d = *toward - *from;
  const double distance = length(d);
  if (!(distance > 0.0) || !std::isfinite(distance)) return {*from, std::nullopt};
  return {*from, Vec2((d / distance) * launch.speed)};
}

const Body* findBody(std::span<const Body> bodies, std::uint32_t id) {
  const auto found =
      std::lower_bound(bodies.begin(), bodies.end(), id,
                       [](const Body& body, std::uint32_t wanted) { return body.id < wanted; });
  return found != bodies.end() && found->id == id ? &*found : nullptr;
}

} // namespace offstage
