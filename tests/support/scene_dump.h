#pragma once

#include "src/scene/scene.h"

#include <string>

namespace offstage::test {

/// Everything that a scene says, as text: two scenes are equal when their dumps are. Doubles by their bits'
/// shortest text; an expression by what it gives at a few states.
std::string dump(const Scene& scene);

} // namespace offstage::test
