#include "src/scene/scene.h"

#include "src/scene/limits.h"
#include "src/scene/parse_clock.h"
#include "src/scene/parse_input.h"
#include "src/scene/parse_overlay.h"
#include "src/scene/parse_panel.h"
#include "src/scene/parse_plot.h"
#include "src/scene/parse_replay.h"
#include "src/scene/parse_timeline.h"
#include "src/scene/quote.h"
#include "src/scene/scene_builder.h"
#include "src/scene/text_file.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <fmt/core.h>

namespace offstage {
namespace {

/// Takes the command line's scale and holds the picture's size in output pixels within bounds.
void checkScale(SceneBuilder& builder, const TableReader& top, const std::optional<double>& given) {
  Scene& scene = builder.scene;
  if (given) {
    const Range allowed = Range::aboveUpTo(0.0, kMaxScale);
    if (!std::isfinite(*given) || !allowed.contains(*given)) {
      builder.errors.add(fmt::format("the scale given for this run must be {}, but it is {}", allowed.text(),
                                     numberText(*given)));
      return;
    }
    scene.scale = *given;
  }
  const double width = std::round(scene.size[0] * scene.scale);
  const double height = std::round(scene.size[1] * scene.scale);
  const double largest = static_cast<double>(kMaxSide);
  if (width >= 1.0 && height >= 1.0 && width <= largest && height <= largest) return;
  const std::string problem =
      fmt::format("size times scale gives a picture of {}x{} px; each side must be from 1 to {}", width,
                  height, kMaxSide);
  if (given) {
    builder.errors.add(problem);
  } else {
    builder.errors.add(*top.find("frame"), problem); // without a [frame], both have their defaults
  }
}

void parseTables(SceneBuilder& builder, const TomlValue& root, const SceneOverrides& overrides) {
  const TableReader top(root, {""}, "", builder.errors);
  Scene& scene = builder.scene;
  scene.title = top.givenString("title").value_or(scene.file.stem().string());
  scene.world.seed =
      top.integer("seed", std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max());
  if (overrides.seed) scene.world.seed = *overrides.seed;

  parseSingle(builder, top, "theme", parseTheme);
  scene.background = scene.theme.background;
  parseSingle(builder, top, "frame", parseFrame);
  checkScale(builder, top, overrides.scale);
  scene.world.pane = Vec2(scene.size[0], scene.size[1]);
  // With another frame rate the last step may end elsewhere.
  builder.lengthIsGiven = overrides.duration || overrides.dtLog || overrides.fps;
  parseClock(builder, singleTable(top, "clock"), top, overrides);
  if (const TomlValue* replay = singleTable(top, "replay")) parseReplay(builder, *replay, top, overrides);
  // The view and the world's integrator come before everything that they hold for.
  parseSingle(builder, top, "view", parseView);
  parseSingle(builder, top, "world", parseWorld);
  parseSingle(builder, top, "walls", parseWalls);
  parseInput(builder, singleTable(top, "input"), overrides);
  // Names come before what refers to them: groups and bodies before collisions and forces.
  parseEach(builder, top, "body", parseBody);
  parseEach(builder, top, "bodies", parseBodies);
  parseEach(builder, top, "spawn", parseSpawn);
  parseEach(builder, top, "launch", parseLaunch);
  parseEach(builder, top, "collide", parseCollide);
  addContacts(builder);
  parseOverlays(builder, top);
  const std::size_t errorsBefore = builder.errors.count();
  parseEach(builder, top, "force", parseForce);
  // Behind a wrong force, what has a closed form cannot be told.
  if (builder.errors.count() == errorsBefore) checkExactBodies(builder, errorsBefore == 0);
  // What reads only the clock comes behind the bodies, to which pauses and cameras point.
  parseTimeline(builder, top, overrides);
  parseSingle(builder, top, "golden", parseGolden);
  // Plots and texts show values of what all others have named.
  parseEach(builder, top, "plot", parsePlot);
  parseEach(builder, top, "text", parseText);
}

/// A scene from a tree, but for its panels.
SceneBuilder parseWhole(const TomlValue& root, const std::filesystem::path& file,
                        const SceneOverrides& overrides) {
  SceneBuilder builder(file);
  parseTables(builder, root, overrides);
  builder.errors.throwIfAny();
  if (builder.scene.world.groups.empty()) builder.scene.world.groups = WorldSetup{}.groups;
  builder.scene.looks = builder.looks.take();
  return builder;
}

} // namespace

Scene loadScene(const std::filesystem::path& file, const SceneOverrides& overrides) {
  return parseScene(readTextFile(file, kMaxSceneBytes, "a scene"), file, overrides);
}

Scene parseScene(std::string_view text, const std::filesystem::path& file, const SceneOverrides& overrides) {
  if (text.size() > kMaxSceneBytes) {
    throw SceneError(file.string(), fmt::format("a scene may hold at most {} bytes", kMaxSceneBytes));
  }
  Diagnostic syntaxError;
  const auto root = parseToml(text, file.string(), syntaxError);
  if (!root) throw SceneError({syntaxError});

  Scene scene = parseWhole(*root, file, overrides).scene;
  const auto parse = [&](const TomlValue& tree, const SceneOverrides& own) {
    return parseWhole(tree, file, own);
  };
  parsePanels(*root, overrides, parse, scene);
  scene.text = text;
  return scene;
}

} // namespace offstage
