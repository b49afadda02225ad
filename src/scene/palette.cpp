#include "src/scene/palette.h"

namespace offstage {

Color inkOn(const Color& background, double opacity) {
  const double luma = 0.2126 * background.red + 0.7152 * background.green + 0.0722 * background.blue;
  const bool dark = background.alpha > 0.5 && luma < 110.0;
  const std::uint8_t value = dark ? 255 : 0;
  return {value, value, value, opacity};
}

} // namespace offstage
