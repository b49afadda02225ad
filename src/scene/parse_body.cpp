#include "src/scene/parse_body.h"

#include "src/scene/parse_look.h"
#include "src/scene/quote.h"

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr Choice<Shape> kShapes[] = {{"circle", Shape::Circle}, {"rectangle", Shape::Rectangle}};
constexpr Choice<bool> kLeavings[] = {{"keep", false}, {"remove", true}};

void readName(SceneBuilder& builder, const TableReader& reader, std::uint32_t id) {
  const auto name = reader.givenString("name");
  builder.scene.bodyNames.push_back(name.value_or(""));
  if (!name) return;
  const std::uint32_t line = reader.find("name")->line;
  if (const auto [place, isNew] = builder.lines.try_emplace(*name, line); !isNew) {
    reader.reject("name", fmt::format("must be unique, but {} is also the body's in line {}",
                                      quotedText(*name), place->second));
    return;
  }
  builder.bodies.emplace(*name, id);
}

} // namespace

void readCommonProperties(SceneBuilder& builder, const TableReader& reader, Body& body) {
  body.group = builder.addGroup(reader.string("group"));
  body.removedOutside = reader.choice("leaving", kLeavings);
  body.restitution = reader.number("restitution", Range::between(0.0, 1.0));
  body.continuous = reader.boolean("continuous");
  body.friction = reader.number("friction", Range::atLeast(0.0));
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

void parseBody(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"body"}, "[[body]]", builder.errors);
  Body body;
  body.id = static_cast<std::uint32_t>(builder.scene.world.bodies.size());
  readName(builder, reader, body.id);
  const bool shapeKnown = readBodyProperties(builder, reader, body);
  body.look = readLooks(builder, reader, false).front();

  if (shapeKnown) {
    rejectKeysOfOtherShape(reader, body.shape, {"center", "radius"}, {"position", "size"});
    if (body.shape == Shape::Circle) {
      body.position = builder.view.position(toVec2(reader.pair("center")));
      body.radius = builder.view.length()(reader.number("radius", Range::atLeast(0.0)));
    } else {
      body.position = builder.view.position(toVec2(reader.pair("position")));
      body.size = builder.view.size(toVec2(reader.pair("size", Range::atLeast(0.0))));
    }
  }
  body.velocity = builder.view.vector(toVec2(reader.pair("velocity")));
  body.acceleration = builder.view.vector(toVec2(reader.pair("acceleration")));
  body.mass = reader.number("mass", Range::above(0.0));
  builder.requireFinite(table, "[[body]]",
                        {body.position.x(), body.position.y(), body.radius, body.size.x(), body.size.y(),
                         body.velocity.x(), body.velocity.y(), body.acceleration.x(), body.acceleration.y()});
  builder.scene.world.bodies.push_back(body);
  builder.bodyTables.push_back(&table);
}

} // namespace offstage
