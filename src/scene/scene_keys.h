#pragma once

#include "src/scene/scene.h"

#include <span>
#include <string_view>

namespace offstage {

/// The one list of what a scene may say. TableReader takes from it which keys a table knows, which of them
/// are required and what the others default to; scenes/README.md is held to it by a test.
std::span<const SceneKey> sceneKeyTable();

/// Those of it that are called `key`, of whatever table, in the list's order. A scene asks for every key of
/// every body.
std::span<const SceneKey* const> sceneKeysNamed(std::string_view key);

} // namespace offstage
