#pragma once

#include "src/scene/scene_builder.h"

namespace offstage {

/// Reads `[replay]` with its `[[replay.look]]`, and the trace that it names, and sets the scene's clock by
/// the trace's times. Reports every other table of `top` that says how bodies move.
void parseReplay(SceneBuilder& builder, const TomlValue& table, const TableReader& top,
                 const SceneOverrides& overrides);

} // namespace offstage
