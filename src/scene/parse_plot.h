#pragma once

#include "src/scene/scene_builder.h"

namespace offstage {

/// [[plot]]. After all bodies and groups, and the clock, are known.
void parsePlot(SceneBuilder& builder, const TomlValue& table);

} // namespace offstage
