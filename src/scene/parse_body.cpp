#include "src/scene/parse_body.h"

#include "src/scene/parse_look.h"
#include "src/scene/quote.h"

#include <cmath>

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr Choice<Shape> kShapes[] = {{"circle", Shape::Circle}, {"rectangle", Shape::Rectangle}};
constexpr Choice<bool> kLeavings[] = {{"keep", false}, {"remove", true}};

void readName(SceneBuilder& builder, const TableReader& reader, std::uint32_t id) {
  const auto name = reader.givenString("name");
  builder.scene.bodyNames.push_back(name.value_or(""));
  if (!name || addBodyName(builder, *name, id, reader.find("name")->line)) return;
  reader.reject("name", fmt::format("must be unique, but {} is also the body's in line {}", quotedText(*name),
                                    builder.lines.at(*name)));
}

} // namespace

bool addBodyName(SceneBuilder& builder, const std::string& name, std::uint32_t id, std::uint32_t line) {
  if (!builder.lines.try_emplace(name, line).second) return false;
  builder.bodies.emplace(name, id);
  return true;
}

void readCommonProperties(SceneBuilder& builder, const TableReader& reader, Body& body) {
  const std::string group = reader.string("group");
  if (group == "*") reader.reject("group", "cannot be \"*\", which stands for all groups in [[collide]]");
  body.group = builder.addGroup(group);
  body.removedOutside = reader.choice("leaving", kLeavings);
  body.continuous = reader.boolean("continuous");
}

void readSurface(const TableReader& reader, Body& body) {
  body.restitution = reader.number("restitution", kRestitutions);
  body.friction = reader.number("friction", kFrictions);
}

bool readBodyProperties(SceneBuilder& builder, const TableReader& reader, Body& body) {
  readCommonProperties(builder, reader, body);
  body.feelsGravity = reader.boolean("gravity");
  body.fixed = reader.boolean("fixed");
  body.integrator = reader.givenChoice("integrator", kIntegrators).value_or(builder.integrator);
  if (const auto shape = reader.givenChoice("shape", kShapes)) {
    body.shape = *shape;
    return true;
  }
  return !reader.has("shape");
}

void rejectKeysOfOtherShape(const TableReader& reader, Shape shape,
                            std::initializer_list<std::string_view> circle,
                            std::initializer_list<std::string_view> rectangle) {
  const bool isCircle = shape == Shape::Circle;
  for (const std::string_view key : isCircle ? rectangle : circle) {
    if (!reader.has(key)) continue;
    reader.reject(key, isCircle ? "belongs to a rectangle, but this shape is a circle"
                                : "belongs to a circle, but this shape is a rectangle");
  }
}

Body readBody(SceneBuilder& builder, const TableReader& reader, BodyNumbers& numbers) {
  Body body;
  const bool shapeKnown = readBodyProperties(builder, reader, body);
  readSurface(reader, body);
  body.look = readLooks(builder, reader, body, false).front();
  if (shapeKnown) {
    rejectKeysOfOtherShape(reader, body.shape, {"center", "radius"}, {"position", "size"});
    if (body.shape == Shape::Circle) {
      numbers.place = reader.pair("center");
      numbers.radius = reader.number("radius", Range::atLeast(0.0));
    } else {
      numbers.place = reader.pair("position");
      numbers.size = reader.pair("size", Range::atLeast(0.0));
    }
  }
  numbers.velocity = reader.pair("velocity");
  numbers.acceleration = reader.pair("acceleration");
  numbers.mass = reader.number("mass", Range::above(0.0));
  numbers.restitution = body.restitution;
  numbers.friction = body.friction;
  return body;
}

Body placed(const View& view, const BodyNumbers& numbers, Body body) {
  body.position = view.position(toVec2(numbers.place));
  body.size = view.size(toVec2(numbers.size));
  body.radius = view.length()(numbers.radius);
  body.velocity = view.vector(toVec2(numbers.velocity));
  body.acceleration = view.vector(toVec2(numbers.acceleration));
  body.mass = numbers.mass;
  body.restitution = numbers.restitution;
  body.friction = numbers.friction;
  return body;
}

bool isFinite(const Body& body) {
  return body.position.allFinite() && body.size.allFinite() && std::isfinite(body.radius) &&
         body.velocity.allFinite() && body.acceleration.allFinite();
}

void parseBody(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"body"}, "[[body]]", builder.errors);
  const auto id = static_cast<std::uint32_t>(builder.scene.world.bodies.size());
  readName(builder, reader, id);
  BodyNumbers numbers;
  const Body kind = readBody(builder, reader, numbers);
  Body body = placed(builder.view, numbers, kind);
  body.id = id;
  if (!isFinite(body)) builder.errors.add(table, "a number in [[body]] is too large for this [view]");
  builder.scene.world.bodies.push_back(body);
  builder.bodyTables.push_back(&table);
}

} // namespace offstage
