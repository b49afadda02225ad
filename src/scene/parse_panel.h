#pragma once

#include "src/scene/scene.h"
#include "src/scene/toml_value.h"

#include <filesystem>
#include <functional>

namespace offstage {

/// Reads [panels] and [[panel]] of a scene whose other tables are right: `scene.panels`, and `scene.size` of
/// the whole picture. `parse` makes a Scene from a tree, with the overrides given; it throws SceneError.
/// Throws SceneError with the errors of all panels, each once.
void parsePanels(const TomlValue& root, const SceneOverrides& overrides,
                 const std::function<Scene(const TomlValue&, const SceneOverrides&)>& parse, Scene& scene);

} // namespace offstage
