#pragma once

#include "src/scene/color.h"
#include "src/scene/look.h"

#include <cstdint>
#include <vector>

namespace offstage {

/// The looks that a scene may choose. None: it has no [theme], so bodies are black on white, as in JavaFX,
/// and what JavaFX does not have (texts, plots, overlays) looks as in Light.
enum class ThemeName : std::uint8_t { None, Light, Dark, Plain };

/// What a scene's parts look like where they do not say it themselves.
struct Theme {
  bool bodies = false;          ///< bodies take their colours from it, too
  Color background{};           ///< of the picture
  Color text{};                 ///< of texts and axes
  Color muted{};                ///< of what stands back: labels of ticks, rulers, bodies that are fixed
  Color grid{};                 ///< of the lines of grids
  std::vector<Color> palette{}; ///< of bodies, group by group, and of curves, one by one; not empty
};

/// Colours of Light and Dark can be told apart with any colour vision: Okabe and Ito, "Color Universal
/// Design" (2008), jfly.uni-koeln.de/color. Their contrast with the background is at least 3:1 for palettes
/// (but for the last three of Light) and 7:1 for texts, by WCAG 2's formula.
Theme themeOf(ThemeName name);

/// The look of a body of this group (an index) that says nothing of its own: its group's colour of the
/// palette, or a fixed body's, with a darker edge inside. `height`: px, of the pane; the edge is 1/240 of it.
/// Without Theme::bodies the look of JavaFX.
Look bodyLook(const Theme& theme, std::uint32_t group, bool fixed, double height);

} // namespace offstage
