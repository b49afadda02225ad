#pragma once

#include "src/scene/scene_builder.h"

namespace offstage {

/// Reads everything that a scene says about its video's time: [timeline], [[section]], [[caption]],
/// [[pause]], [[speed]],
/// [[camera]], [narration], [sound] and [poster], after the clock and the bodies are known. Sound files are
/// only looked for. What lies after the video's end is reported here unless it depends on how long a
/// narration is.
void parseTimeline(SceneBuilder& builder, const TableReader& top, const SceneOverrides& overrides);

/// One function a table; each reports every error in it.
void parseSection(SceneBuilder& builder, const TomlValue& table);
void parseCaption(SceneBuilder& builder, const TomlValue& table); ///< after the sections

/// The section that a key `section` names, by its title; an unknown one is reported. Nothing without the key.
std::optional<std::size_t> readSectionName(SceneBuilder& builder, const TableReader& reader);

} // namespace offstage
