#include "src/scene/expression.h"
#include "src/scene/limits.h"
#include "src/scene/scene_builder.h"

#include <utility>

#include <fmt/core.h>

namespace offstage {
namespace {

enum class ForceType : std::uint8_t { Drag, Spring, Attract, Wind, Expression };

constexpr Choice<ForceType> kTypes[] = {{"drag", ForceType::Drag},
                                        {"spring", ForceType::Spring},
                                        {"attract", ForceType::Attract},
                                        {"wind", ForceType::Wind},
                                        {"expression", ForceType::Expression}};
constexpr std::string_view kLabel = "[[force]]";

DragForce readDrag(const SceneBuilder& builder, const TableReader& reader) {
  return {reader.number("linear", Range::atLeast(0.0)),
          builder.view.perLength(reader.number("quadratic", Range::atLeast(0.0)))};
}

SpringForce readSpring(SceneBuilder& builder, const TableReader& reader) {
  SpringForce spring;
  spring.to = builder.readAnchor(reader, "to").value_or(Anchor{});
  spring.stiffness = reader.number("stiffness", Range::atLeast(0.0));
  spring.length = builder.view.length()(reader.number("length", Range::atLeast(0.0)));
  spring.damping = reader.number("damping", Range::atLeast(0.0));
  return spring;
}

AttractForce readAttract(SceneBuilder& builder, const TableReader& reader) {
  AttractForce attract;
  attract.to = builder.readAnchor(reader, "to").value_or(Anchor{});
  attract.strength = builder.view.attraction(reader.number("strength"));
  attract.softening = builder.view.length()(reader.number("softening", Range::atLeast(0.0)));
  return attract;
}

WindForce readWind(const SceneBuilder& builder, const TableReader& reader) {
  const auto velocity = reader.pair("velocity");
  return {builder.view.vector({velocity[0], velocity[1]}), reader.number("coefficient", Range::atLeast(0.0))};
}

/// The two expressions as a function of the simulation's state, in the scene's units. Plain members, so that
/// copies of a world share nothing.
struct ExpressionForce {
  View view;
  Expression fx;
  Expression fy;

  Vec2 operator()(const ForceState& simulated) const {
    const ForceState state = view.toScene(simulated);
    const ExpressionVariables variables{state.position.x(), state.position.y(), state.velocity.x(),
                                        state.velocity.y(), state.time,         state.mass};
    return view.vector({fx(variables), fy(variables)});
  }
};

Expression readExpression(const TableReader& reader, std::string_view key) {
  const std::string text = reader.string(key);
  try {
    return Expression(text);
  } catch (const ExpressionError& error) {
    const std::string place = error.character() > 0 ? fmt::format(" (character {})", error.character()) : "";
    reader.reject(key, fmt::format("is not a valid expression: {}{}", error.what(), place));
    return Expression("0");
  }
}

CustomForce readExpressions(const SceneBuilder& builder, const TableReader& reader) {
  if (!reader.has("fx") && !reader.has("fy")) {
    reader.errors().add(reader.value(), "a force of type \"expression\" needs 'fx', 'fy' or both");
  }
  return {ExpressionForce{builder.view, readExpression(reader, "fx"), readExpression(reader, "fy")}};
}

/// Which bodies the force acts on: one group, one body, or all.
void readScope(SceneBuilder& builder, const TableReader& reader, Force& force) {
  reader.rejectBoth("body", "group");
  if (const TomlValue* group = reader.find("group")) {
    force.group = builder.findGroup(*group, reader.described("group"));
  }
  if (const TomlValue* body = reader.find("body")) {
    force.body = builder.findBody(*body, reader.described("body"));
  }
}

void requireFinite(SceneBuilder& builder, const TomlValue& table, const Force& force) {
  const std::string label(kLabel);
  if (const auto* drag = std::get_if<DragForce>(&force.kind)) {
    builder.requireFinite(table, label, {drag->quadratic});
  } else if (const auto* spring = std::get_if<SpringForce>(&force.kind)) {
    builder.requireFinite(table, label, {spring->length, spring->to.point.x(), spring->to.point.y()});
  } else if (const auto* attract = std::get_if<AttractForce>(&force.kind)) {
    builder.requireFinite(
        table, label, {attract->strength, attract->softening, attract->to.point.x(), attract->to.point.y()});
  } else if (const auto* wind = std::get_if<WindForce>(&force.kind)) {
    builder.requireFinite(table, label, {wind->velocity.x(), wind->velocity.y()});
  }
}

template <typename Read>
void addForce(SceneBuilder& builder, const TomlValue& table, std::string_view keys, const Read& read) {
  const TableReader reader(table, {"force", keys}, std::string(kLabel), builder.errors);
  Force force;
  readScope(builder, reader, force);
  force.kind = read(builder, reader);
  requireFinite(builder, table, force);
  if (const auto* spring = std::get_if<SpringForce>(&force.kind)) {
    if (force.body && spring->to.body == force.body)
      reader.reject("to", "names the very body that the spring acts on");
  }
  builder.scene.world.forces.push_back(std::move(force));
}

} // namespace

void parseForce(SceneBuilder& builder, const TomlValue& table) {
  if (builder.scene.world.forces.size() == kMaxForces) {
    builder.errors.add(table, fmt::format("a scene may have at most {} [[force]]", kMaxForces));
    return;
  }
  const auto type = [&]() -> std::optional<ForceType> {
    // Its unknown keys are reported by the reader that knows the type; this one only looks at the type.
    ErrorList ignored{""};
    const TableReader reader(table, {"force"}, std::string(kLabel), ignored);
    return reader.givenChoice("type", kTypes);
  }();
  if (!type) {
    const TableReader reader(
        table, {"force", "force.drag", "force.spring", "force.attract", "force.wind", "force.expression"},
        std::string(kLabel), builder.errors);
    if (!reader.has("type")) reader.require("type");
    static_cast<void>(reader.givenChoice("type", kTypes));
    return;
  }
  switch (*type) {
  case ForceType::Drag:
    return addForce(builder, table, "force.drag", readDrag);
  case ForceType::Spring:
    return addForce(builder, table, "force.spring", readSpring);
  case ForceType::Attract:
    return addForce(builder, table, "force.attract", readAttract);
  case ForceType::Wind:
    return addForce(builder, table, "force.wind", readWind);
  case ForceType::Expression:
    return addForce(builder, table, "force.expression", readExpressions);
  }
}

} // namespace offstage
