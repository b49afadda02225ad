#include "src/scene/theme.h"

#include <algorithm>

namespace offstage {
namespace {

// Okabe and Ito's names and values.
constexpr Color kOrange = Color::rgb(0xe6, 0x9f, 0x00);
constexpr Color kSkyBlue = Color::rgb(0x56, 0xb4, 0xe9);
constexpr Color kBluishGreen = Color::rgb(0x00, 0x9e, 0x73);
constexpr Color kYellow = Color::rgb(0xf0, 0xe4, 0x42);
constexpr Color kBlue = Color::rgb(0x00, 0x72, 0xb2);
constexpr Color kVermillion = Color::rgb(0xd5, 0x5e, 0x00);
constexpr Color kReddishPurple = Color::rgb(0xcc, 0x79, 0xa7);

Theme light() {
  return {true,
          Color::rgb(0xfc, 0xfb, 0xf8),
          Color::rgb(0x1f, 0x29, 0x33),
          Color::rgb(0x5f, 0x6b, 0x76),
          Color::rgb(0xdd, 0xe1, 0xe4),
          {kBlue, kVermillion, kBluishGreen, kReddishPurple, kOrange, kSkyBlue}};
}

Theme dark() {
  return {true,
          Color::rgb(0x14, 0x19, 0x1f),
          Color::rgb(0xe9, 0xec, 0xef),
          Color::rgb(0x9a, 0xa6, 0xb2),
          Color::rgb(0x2d, 0x36, 0x3f),
          {kSkyBlue, kOrange, kBluishGreen, kYellow, kReddishPurple, kVermillion}};
}

Color darker(const Color& color) {
  const auto less = [](std::uint8_t channel) { return static_cast<std::uint8_t>(channel * 7 / 10); };
  return {less(color.red), less(color.green), less(color.blue), color.alpha};
}

} // namespace

Theme themeOf(ThemeName name) {
  constexpr Color kWhite = Color::rgb(255, 255, 255);
  switch (name) {
  case ThemeName::Light:
    return light();
  case ThemeName::Dark:
    return dark();
  case ThemeName::None:
  case ThemeName::Plain:
    break;
  }
  Theme theme = light();
  theme.bodies = false;
  theme.background = kWhite;
  if (name == ThemeName::Plain) theme.text = Color{};
  return theme;
}

Look bodyLook(const Theme& theme, std::uint32_t group, bool fixed, double height) {
  Look look;
  if (!theme.bodies) return look;
  const Color color = fixed ? theme.muted : theme.palette.at(group % theme.palette.size());
  look.fill = color;
  Stroke edge;
  edge.paint = darker(color);
  edge.width = std::max(height / 240.0, 1.0);
  edge.align = StrokeAlign::Inside;
  look.stroke = edge;
  return look;
}

} // namespace offstage
