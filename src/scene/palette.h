#pragma once

#include "src/scene/color.h"

#include <array>
#include <cstddef>

namespace offstage {

/// Colours that people with any colour vision tell apart: Okabe and Ito, Color Universal Design (2008). What
/// a scene gives no colour of its own takes these, in this order, on light and dark grounds.
namespace palette {
inline constexpr Color kBlue{0, 114, 178, 1.0};
inline constexpr Color kVermilion{213, 94, 0, 1.0};
inline constexpr Color kGreen{0, 158, 115, 1.0};
inline constexpr Color kPurple{204, 121, 167, 1.0};
inline constexpr Color kOrange{230, 159, 0, 1.0};
inline constexpr Color kSky{86, 180, 233, 1.0};
inline constexpr std::array<Color, 6> kSeries{kBlue, kVermilion, kGreen, kPurple, kOrange, kSky};
} // namespace palette

struct Theme;

/// Black on a light background, white on a dark one, by its luma (ITU-R BT.709), with this opacity (0 … 1).
Color inkOn(const Color& background, double opacity = 1.0);

// What overlays and plots take where the scene gives no colour: the theme's, where it has one.
Color inkOf(const Theme& theme, const Color& background, double opacity = 1.0);
Color gridColorOf(const Theme& theme, const Color& background);
Color seriesColor(const Theme& theme, std::size_t index); ///< of the curves of a plot, by turns

} // namespace offstage
