#include "src/scene/theme.h"
#include "tests/support/scene_text.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

const Look& lookOf(const Scene& scene, std::size_t body) {
  return scene.looks.at(scene.world.bodies.at(body).look);
}

const std::string kBodies = "[[body]]\ngroup = \"a\"\ncenter = [1, 2]\nradius = 3\n"
                            "[[body]]\ngroup = \"b\"\ncenter = [1, 2]\nradius = 3\n"
                            "[[body]]\ngroup = \"a\"\ncenter = [1, 2]\nradius = 3\nfixed = true\n"
                            "[[body]]\ngroup = \"b\"\ncenter = [1, 2]\nradius = 3\nfill = \"red\"\n";

TEST(Theme, WithoutOneBodiesAreBlackOnWhite) {
  const Scene scene = sceneOf(kBodies);
  EXPECT_EQ(scene.background, Color::rgb(255, 255, 255));
  EXPECT_EQ(std::get<Color>(*lookOf(scene, 0).fill), Color{});
  EXPECT_FALSE(lookOf(scene, 0).stroke.has_value());
}

TEST(Theme, ColoursUnstyledBodiesByGroup) {
  const Scene scene = sceneOf("[theme]\nname = \"dark\"\npalette = [\"#102030\", \"#405060\"]\n" + kBodies);
  EXPECT_EQ(scene.background, themeOf(ThemeName::Dark).background);
  EXPECT_EQ(std::get<Color>(*lookOf(scene, 0).fill), Color::rgb(0x10, 0x20, 0x30));
  EXPECT_EQ(std::get<Color>(*lookOf(scene, 1).fill), Color::rgb(0x40, 0x50, 0x60));
  EXPECT_EQ(std::get<Color>(*lookOf(scene, 2).fill), themeOf(ThemeName::Dark).muted);
  EXPECT_EQ(std::get<Color>(*lookOf(scene, 3).fill), Color::rgb(255, 0, 0));
  EXPECT_TRUE(lookOf(scene, 0).stroke.has_value());
  EXPECT_FALSE(lookOf(scene, 3).stroke.has_value()) << "the theme's edge belongs to its fill";
}

TEST(Theme, PlainIsAsWithoutOneAndAFramesBackgroundCountsMore) {
  const Scene plain = sceneOf("[theme]\nname = \"plain\"\n" + kBodies);
  EXPECT_EQ(plain.background, Color::rgb(255, 255, 255));
  EXPECT_EQ(std::get<Color>(*lookOf(plain, 0).fill), Color{});
  EXPECT_EQ(plain.theme.text, Color{});
  EXPECT_EQ(sceneOf("[theme]\n[frame]\nbackground = \"red\"\n").background, Color::rgb(255, 0, 0));
}

TEST(Theme, TextsTakeItsColour) {
  const std::string text = "[[text]]\ntext = \"x\"\nplace = \"top\"\n";
  EXPECT_EQ(sceneOf("[theme]\ntext = \"#123456\"\n" + text).texts.at(0).look.color,
            Color::rgb(0x12, 0x34, 0x56));
  EXPECT_EQ(sceneOf(text).texts.at(0).look.color, themeOf(ThemeName::Light).text);
}

/// Relative luminance and contrast as WCAG 2.1 defines them.
double luminance(const Color& color) {
  const auto linear = [](std::uint8_t channel) {
    const double c = channel / 255.0;
    return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.red) + 0.7152 * linear(color.green) + 0.0722 * linear(color.blue);
}

double contrast(const Color& a, const Color& b) {
  const double lighter = std::max(luminance(a), luminance(b));
  const double darker = std::min(luminance(a), luminance(b));
  return (lighter + 0.05) / (darker + 0.05);
}

TEST(Theme, CanBeReadFromTheLastRow) {
  for (const ThemeName name : {ThemeName::Light, ThemeName::Dark}) {
    const Theme theme = themeOf(name);
    EXPECT_GT(contrast(theme.text, theme.background), 7.0);
    EXPECT_GT(contrast(theme.muted, theme.background), 4.5);
    const std::size_t sure = name == ThemeName::Light ? 3 : theme.palette.size();
    for (std::size_t i = 0; i < sure; ++i)
      EXPECT_GT(contrast(theme.palette[i], theme.background), 3.0) << "colour " << i;
  }
}

} // namespace
} // namespace offstage::test
