#pragma once

#include "src/scene/scene_builder.h"
#include "src/scene/toml_value.h"

#include <filesystem>
#include <functional>

namespace offstage {

/// Makes a scene from a tree, but for its panels, with the overrides given. Throws SceneError.
using ScenePart = std::function<SceneBuilder(const TomlValue&, const SceneOverrides&)>;

/// Reads [panels] and [[panel]] of a scene whose other tables are right: `scene.panels`, and `scene.size` of
/// the whole picture. Throws SceneError with the errors of all panels, each once.
void parsePanels(const TomlValue& root, const SceneOverrides& overrides, const ScenePart& parse,
                 Scene& scene);

} // namespace offstage
