#pragma once

#include "src/sim/world_setup.h"

namespace offstage {

/// Throws Error(BadInput) when a setup cannot be simulated: an index that points nowhere, a mass that is not
/// above 0, two rules for one pair of groups, an Exact body without a closed form, and so on; the message
/// says where. Positions and velocities may be anything, infinite or NaN too.
void checkSetup(const WorldSetup& setup);

} // namespace offstage
