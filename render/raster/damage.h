#pragma once

#include "render/raster/display_list.h"
#include "render/raster/tile_set.h"

#include <vector>

namespace offstage {

/// Adds the tiles whose pixels may differ between two display lists that differ in `changes`, and in neither
/// background nor clip. A tile that lies wholly under the same plain colour before and after has not changed,
/// whatever moved below.
void findDamage(const DisplayList& before, const DisplayList& now, const std::vector<LayerChange>& changes,
                TileSet& tiles);

} // namespace offstage
