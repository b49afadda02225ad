#include "src/scene/palette.h"

#include "src/scene/theme.h"

#include <tuple>

namespace offstage {
namespace {

/// Whether it is the theme of a scene that has chosen none. Such a scene may have any background, so what is
/// drawn on it takes an ink that shows.
bool isNone(const Theme& theme) {
  const auto parts = [](const Theme& t) { return std::tie(t.bodies, t.text, t.muted, t.grid, t.palette); };
  const Theme none = themeOf(ThemeName::None);
  return parts(theme) == parts(none);
}

} // namespace

Color inkOn(const Color& background, double opacity) {
  const double luma = 0.2126 * background.red + 0.7152 * background.green + 0.0722 * background.blue;
  const bool dark = background.alpha > 0.5 && luma < 110.0;
  const std::uint8_t value = dark ? 255 : 0;
  return {value, value, value, opacity};
}

Color inkOf(const Theme& theme, const Color& background, double opacity) {
  if (isNone(theme)) return inkOn(background, opacity);
  Color ink = theme.text;
  ink.alpha *= opacity;
  return ink;
}

Color gridColorOf(const Theme& theme, const Color& background) {
  return isNone(theme) ? inkOn(background, 0.12) : theme.grid;
}

Color seriesColor(const Theme& theme, std::size_t index) {
  if (!isNone(theme)) return theme.palette[index % theme.palette.size()];
  return palette::kSeries.at(index % palette::kSeries.size());
}

} // namespace offstage
