#pragma once

#include "src/scene/scene_builder.h"
#include "src/scene/text_look.h"

namespace offstage {

inline constexpr Choice<NinePosition> kNinePositions[] = {
    {"top-left", NinePosition::TopLeft},
    {"top", NinePosition::Top},
    {"top-right", NinePosition::TopRight},
    {"left", NinePosition::Left},
    {"center", NinePosition::Center},
    {"right", NinePosition::Right},
    {"bottom-left", NinePosition::BottomLeft},
    {"bottom", NinePosition::Bottom},
    {"bottom-right", NinePosition::BottomRight},
};

/// The px of a text that does not say its size: a twentieth of the pane's height, so that it can be read from
/// a lecture hall's last row.
double defaultTextSize(const SceneBuilder& builder);

/// The font of a key: "sans", "sans-bold", "mono", "mono-bold" or a file beside the scene. Without the key
/// the default.
FontChoice readFont(SceneBuilder& builder, const TableReader& reader, std::string_view key);

/// A colour that may be left out.
std::optional<Color> readGivenColor(const TableReader& reader, std::string_view key);

} // namespace offstage
