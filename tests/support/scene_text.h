#pragma once

#include "src/scene/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace offstage::test {

/// Parses a scene as the file "scene.toml" of a folder that holds nothing.
Scene sceneOf(std::string_view text, const SceneOverrides& overrides = {});

/// Every error's text() of such a scene, in order; empty when it has none.
std::vector<std::string> errorsOf(std::string_view text, const SceneOverrides& overrides = {});

/// The example scene of the design's "Scene files", word for word.
std::string_view designScene();

} // namespace offstage::test
