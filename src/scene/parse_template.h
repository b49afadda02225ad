#pragma once

#include "src/scene/scene_builder.h"
#include "src/scene/text_template.h"

#include <optional>
#include <string>

namespace offstage {

/// Reads a template from a key's string, resolving the probes. Reports what is wrong with it, each with its
/// character (from 1), and then returns nothing. After all bodies and groups are known.
std::optional<TextTemplate> readTemplate(SceneBuilder& builder, const TomlValue& value,
                                         const std::string& what);

} // namespace offstage
