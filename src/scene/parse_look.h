#pragma once

#include "src/scene/scene_builder.h"

#include <cstdint>
#include <vector>

namespace offstage {

/// The looks that a table's fill, stroke and opacity give, as indices: one, or as many as a spawn's
/// `fill = { cycle = […] }` has colours. Never empty. `body`: whose looks they are, for the theme's colour of
/// its group; its group is known already.
std::vector<std::uint32_t> readLooks(SceneBuilder& builder, const TableReader& reader, const Body& body,
                                     bool mayCycle);

} // namespace offstage
