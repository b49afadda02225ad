#pragma once

#include "src/scene/scene_builder.h"

namespace offstage {

/// [input], or null when it is absent, and what a command line puts in its place.
void parseInput(SceneBuilder& builder, const TomlValue* table, const SceneOverrides& overrides);

} // namespace offstage
