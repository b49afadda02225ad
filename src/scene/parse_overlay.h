#pragma once

#include "src/scene/scene_builder.h"

namespace offstage {

/// What is drawn over and under the bodies: [grid], [[trail]], [[ghost]], [[outline]], [[mark]], [[arrow]],
/// [[contact_mark]], [[ruler]]. After all bodies, groups and the replay are known.
void parseOverlays(SceneBuilder& builder, const TableReader& top);

} // namespace offstage
