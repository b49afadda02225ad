#pragma once

#include "src/scene/scene_builder.h"

namespace offstage {

/// Reads [clock] (null when absent) and duration, with what the command line replaces of them, into the
/// scene's clock and substeps. `top` is the reader of the top level.
void parseClock(SceneBuilder& builder, const TomlValue* table, const TableReader& top,
                const SceneOverrides& overrides);

} // namespace offstage
