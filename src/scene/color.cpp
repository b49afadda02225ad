#include "src/scene/color.h"

#include "src/scene/color_names.h"
#include "src/scene/nearest.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

namespace offstage {
namespace {

constexpr std::string_view kTransparent = "transparent";

std::uint8_t byteOf(double component) {
  // Written so that NaN gives 0.
  if (!(component > 0.0)) return 0;
  return static_cast<std::uint8_t>(std::floor(255.0 * std::min(component, 1.0)));
}

std::optional<std::uint32_t> hexDigit(char digit) {
  if (digit >= '0' && digit <= '9') return static_cast<std::uint32_t>(digit - '0');
  if (digit >= 'a' && digit <= 'f') return static_cast<std::uint32_t>(digit - 'a' + 10);
  if (digit >= 'A' && digit <= 'F') return static_cast<std::uint32_t>(digit - 'A' + 10);
  return std::nullopt;
}

/// The smallest-error alpha that alphaByte() gives back as `byte`. byte/255 is not always that: rounded down,
/// 255 times it would fall below the byte and floor would take one off.
double alphaOf(std::uint32_t byte) {
  double alpha = byte / 255.0;
  while (std::floor(255.0 * alpha) < byte) alpha = std::nextafter(alpha, 1.0);
  return alpha;
}

std::optional<Color> parseHex(std::string_view digits) {
  const bool isShort = digits.size() == 3 || digits.size() == 4;
  if (!isShort && digits.size() != 6 && digits.size() != 8) return std::nullopt;
  std::array<std::uint32_t, 4> bytes{0, 0, 0, 255};
  const std::size_t digitsPerByte = isShort ? 1 : 2;
  for (std::size_t i = 0; i < digits.size() / digitsPerByte; ++i) {
    const auto high = hexDigit(digits[i * digitsPerByte]);
    const auto low = hexDigit(digits[i * digitsPerByte + digitsPerByte - 1]);
    if (!high || !low) return std::nullopt;
    bytes.at(i) = *high * 16 + *low;
  }
  return Color{static_cast<std::uint8_t>(bytes[0]), static_cast<std::uint8_t>(bytes[1]),
               static_cast<std::uint8_t>(bytes[2]), alphaOf(bytes[3])};
}

} // namespace

Color Color::unit(double red, double green, double blue, double alpha) {
  return {byteOf(red), byteOf(green), byteOf(blue), alpha > 0.0 ? std::min(alpha, 1.0) : 0.0};
}

std::uint8_t Color::alphaByte(double opacity) const {
  return byteOf(alpha * opacity);
}

std::optional<Color> parseColor(std::string_view text) {
  if (text.starts_with('#')) return parseHex(text.substr(1));
  std::string name(text);
  std::transform(name.begin(), name.end(), name.begin(), [](char letter) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  });
  if (name == kTransparent) return Color{0, 0, 0, 0.0};
  const auto names = namedColors();
  const auto found = std::lower_bound(
      names.begin(), names.end(), name,
      [](const NamedColor& candidate, const std::string& wanted) { return candidate.name < wanted; });
  if (found == names.end() || found->name != name) return std::nullopt;
  return Color{static_cast<std::uint8_t>(found->rgb >> 16U),
               static_cast<std::uint8_t>(found->rgb >> 8U & 0xffU),
               static_cast<std::uint8_t>(found->rgb & 0xffU), 1.0};
}

std::string_view nearestColorName(std::string_view text) {
  std::vector<std::string_view> names;
  for (const NamedColor& color : namedColors()) names.push_back(color.name);
  names.push_back(kTransparent);
  return nearest(text, names);
}

} // namespace offstage
