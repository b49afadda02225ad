#pragma once

#include "src/scene/scene.h"

#include <span>

namespace offstage {

/// The one list of what a scene may say. TableReader takes from it which keys a table knows, which of them
/// are required and what the others default to; scenes/README.md is held to it by a test.
std::span<const SceneKey> sceneKeyTable();

} // namespace offstage
