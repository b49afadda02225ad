#pragma once

#include "src/scene/scene_builder.h"

#include <span>

namespace offstage {

/// [[panels.plot]], of `panels`, the table [panels], into Panels::plots. After the panels, their layout and
/// Scene::size are known. `builders`: by panel, the names that its values may refer to.
void parsePanelPlots(const TableReader& panels, std::span<const SceneBuilder> builders, Scene& scene);

} // namespace offstage
