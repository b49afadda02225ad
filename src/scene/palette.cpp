#include "src/scene/palette.h"

#include "src/scene/theme.h"

namespace offstage {

Color inkOn(const Color& background, double opacity) {
  const double luma = 0.2126 * background.red + 0.7152 * background.green + 0.0722 * background.blue;
  const bool dark = background.alpha > 0.5 && luma < 110.0;
  const std::uint8_t value = dark ? 255 : 0;
  return {value, value, value, opacity};
}

Color inkOf(const Theme& theme, const Color& background, double opacity) {
  if (!theme.given) return inkOn(background, opacity);
  Color ink = theme.text;
  ink.alpha *= opacity;
  return ink;
}

Color gridColorOf(const Theme& theme, const Color& background) {
  return theme.given ? theme.grid : inkOn(background, 0.12);
}

Color seriesColor(const Theme& theme, std::size_t index) {
  if (theme.given && !theme.palette.empty()) return theme.palette[index % theme.palette.size()];
  return palette::kSeries.at(index % palette::kSeries.size());
}

} // namespace offstage
