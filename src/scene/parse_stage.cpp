// The tables of which a scene has one each: [frame], [view], [world], [walls]. [clock] has a file of its own.

#include "src/scene/limits.h"
#include "src/scene/parse_body.h"
#include "src/scene/warning_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace offstage {
namespace {

/// Far beyond any picture, and small enough that cubes of it stay finite.
constexpr double kLargestPixelsPerMetre = 1e6;
constexpr double kSmallestPixelsPerMetre = 1e-6;
constexpr double kFarthestOrigin = 1e9;

/// Parts that the solver divides a step into where [clock] does not say: piles of a thousand neither sink
/// nor boil with it, as scenes/pile.toml shows.
constexpr int kSolverSubsteps = 4;
constexpr std::int64_t kMaxIterations = 1000;

void readContactModel(SceneBuilder& builder, const TableReader& reader) {
  constexpr Choice<ContactModel> kModels[] = {{"lecture", ContactModel::Lecture},
                                              {"solver", ContactModel::Solver}};
  WorldSetup& world = builder.scene.world;
  world.contactModel = reader.choice("contacts", kModels);
  world.iterations = static_cast<int>(reader.integer("iterations", 1, kMaxIterations));
  if (world.contactModel == ContactModel::Solver) {
    if (!builder.substepsGiven) world.substeps = kSolverSubsteps;
  } else if (reader.has("iterations")) {
    reader.reject("iterations", "belongs to contacts = \"solver\"");
  }
}

/// The kinds of warnings that the scene is meant to show.
void readExpected(SceneBuilder& builder, const TableReader& reader) {
  const TomlValue* value = reader.find("expect");
  if (value == nullptr) return;
  const std::string wanted = fmt::format("\"{}\"", fmt::join(warningWords(), "\", \""));
  if (value->array() == nullptr) {
    reportMismatch(*value, reader.described("expect"), "a list of " + wanted, builder.errors);
    return;
  }
  const auto words = warningWords();
  for (const TomlValue& element : *value->array()) {
    const auto* word = std::get_if<std::string>(&element.data);
    const auto found = word == nullptr ? words.end() : std::find(words.begin(), words.end(), *word);
    if (found == words.end()) {
      reportMismatch(element, "every value of " + reader.described("expect"), "one of " + wanted,
                     builder.errors);
    } else {
      builder.scene.expectedWarnings.push_back(static_cast<std::size_t>(found - words.begin()));
    }
  }
}

void readSize(SceneBuilder& builder, const TableReader& reader) {
  const TomlValue* size = reader.find("size");
  if (size == nullptr) return;
  const std::string what = reader.described("size");
  if (size->array() == nullptr || size->array()->size() != 2) {
    reportMismatch(*size, what, "an array of 2 integers", builder.errors);
    return;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const auto side = readInteger((*size->array())[i], fmt::format("value {} of {}", i + 1, what), 1,
                                  kMaxSide, builder.errors);
    if (side) builder.scene.size[i] = static_cast<int>(*side);
  }
}

} // namespace

void parseFrame(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"frame"}, "[frame]", builder.errors);
  readSize(builder, reader);
  if (reader.has("background")) builder.scene.background = reader.color("background");
  builder.scene.scale = reader.number("scale", Range::aboveUpTo(0.0, kMaxScale));
}

void parseView(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"view"}, "[view]", builder.errors);
  const double pixels =
      reader.number("pixels_per_metre", Range::between(kSmallestPixelsPerMetre, kLargestPixelsPerMetre));
  const Vec2 origin = toVec2(reader.pair("origin", Range::between(-kFarthestOrigin, kFarthestOrigin)));
  builder.view = View(pixels, origin, reader.boolean("y_up"));
}

void parseWorld(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"world"}, "[world]", builder.errors);
  if (const auto gravity = reader.givenNumbers<2>("gravity")) {
    builder.scene.world.gravity = builder.view.vector(toVec2(*gravity));
    builder.requireFinite(table, "[world]",
                          {builder.scene.world.gravity.x(), builder.scene.world.gravity.y()});
  }
  builder.integrator = reader.choice("integrator", kIntegrators);
  readContactModel(builder, reader);
  readExpected(builder, reader);
}

void parseWalls(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"walls"}, "[walls]", builder.errors);
  Walls& walls = builder.scene.world.walls;
  walls.clamp = reader.boolean("clamp");
  if (!walls.clamp && builder.scene.world.contactModel == ContactModel::Solver) {
    reader.reject("clamp", "cannot be false with [world] contacts = \"solver\"");
  }
  const auto all = reader.givenNumber("all", Range::atLeast(0.0));
  constexpr Choice<Side> kSides[] = {
      {"left", Side::Left}, {"right", Side::Right}, {"top", Side::Top}, {"bottom", Side::Bottom}};
  for (const auto& [key, side] : kSides) {
    const auto own = reader.givenNumber(key, Range::atLeast(0.0));
    walls.restitution.at(static_cast<std::size_t>(side)) = own ? own : all;
  }
}

} // namespace offstage
