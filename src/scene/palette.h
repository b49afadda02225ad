#pragma once

#include "src/scene/color.h"

#include <array>

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

/// Black on a light background, white on a dark one, by its luma (ITU-R BT.709), with this opacity (0 … 1).
Color inkOn(const Color& background, double opacity = 1.0);

} // namespace offstage
