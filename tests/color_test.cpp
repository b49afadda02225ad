#include "src/scene/color.h"
#include "src/scene/color_names.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

TEST(Color, ComponentsAreFlooredAsJavaFxDoes) {
  EXPECT_EQ(Color::unit(0.5, 0.0, 1.0), Color::rgb(127, 0, 255));
  EXPECT_EQ(Color::unit(0.999, 0.004, 0.25), Color::rgb(254, 1, 63));
}

TEST(Color, ComponentsOutOfRangeAreClamped) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Color::unit(-1.0, 2.0, nan, 7.0), Color::rgb(0, 255, 0));
  EXPECT_EQ(Color::unit(0.0, 0.0, 0.0, -0.5).alpha, 0.0);
  EXPECT_EQ(Color::unit(0.0, 0.0, 0.0, nan).alpha, 0.0);
}

TEST(Color, AlphaByteIsFlooredAfterTheOpacityIsMultipliedIn) {
  EXPECT_EQ(Color::rgb(0, 0, 0, 0.5).alphaByte(), 127);
  EXPECT_EQ(Color::rgb(0, 0, 0, 0.5).alphaByte(0.5), 63);
  EXPECT_EQ(Color::rgb(0, 0, 0).alphaByte(1.0), 255);
  EXPECT_EQ(Color::rgb(0, 0, 0).alphaByte(0.0), 0);
  EXPECT_EQ(Color::rgb(0, 0, 0).alphaByte(-1.0), 0);
  EXPECT_EQ(Color::rgb(0, 0, 0, 1.0).alphaByte(std::numeric_limits<double>::infinity()), 255);
}

TEST(Color, EveryAlphaByteOfAHexColourComesBack) {
  for (unsigned byte = 0; byte < 256; ++byte) {
    const std::string text = fmt::format("#123456{:02x}", byte);
    const auto color = parseColor(text);
    ASSERT_TRUE(color.has_value()) << text;
    EXPECT_EQ(color->alphaByte(), byte) << text << " has alpha " << color->alpha;
    EXPECT_NEAR(color->alpha, byte / 255.0, 1e-15) << text;
  }
}

TEST(Color, HexForms) {
  EXPECT_EQ(parseColor("#1af"), Color::rgb(0x11, 0xaa, 0xff));
  EXPECT_EQ(parseColor("#1AF"), Color::rgb(0x11, 0xaa, 0xff));
  EXPECT_EQ(parseColor("#00fa9a"), Color::rgb(0x00, 0xfa, 0x9a));
  EXPECT_EQ(parseColor("#fff8")->alphaByte(), 0x88);
  EXPECT_EQ(parseColor("#01020380")->alphaByte(), 128);
}

TEST(Color, AllNamesOfCssColor4) {
  EXPECT_EQ(namedColors().size(), 148U);
  EXPECT_TRUE(std::is_sorted(namedColors().begin(), namedColors().end(),
                             [](const NamedColor& a, const NamedColor& b) { return a.name < b.name; }));
  for (const NamedColor& named : namedColors()) {
    const auto color = parseColor(named.name);
    ASSERT_TRUE(color.has_value()) << named.name;
    EXPECT_EQ(color, parseColor(fmt::format("#{:06x}", named.rgb))) << named.name;
  }
  // Those in which CSS differs from X11, and one of each end of the list.
  EXPECT_EQ(parseColor("green"), Color::rgb(0, 128, 0));
  EXPECT_EQ(parseColor("gray"), Color::rgb(128, 128, 128));
  EXPECT_EQ(parseColor("maroon"), Color::rgb(128, 0, 0));
  EXPECT_EQ(parseColor("purple"), Color::rgb(128, 0, 128));
  EXPECT_EQ(parseColor("rebeccapurple"), Color::rgb(0x66, 0x33, 0x99));
  EXPECT_EQ(parseColor("aliceblue"), Color::rgb(240, 248, 255));
  EXPECT_EQ(parseColor("yellowgreen"), Color::rgb(154, 205, 50));
}

TEST(Color, NamesIgnoreCase) {
  EXPECT_EQ(parseColor("RebeccaPurple"), parseColor("rebeccapurple"));
  EXPECT_EQ(parseColor("Transparent"), Color::rgb(0, 0, 0, 0.0));
}

TEST(Color, OtherTextIsNoColour) {
  for (const char* text : {"", "#", "#1", "#12", "#12345", "#1234567", "#123456789", "#ggg", "#12 456", "re",
                           "redd", " red", "red ", "none", "rgb(1,2,3)", "\xff"}) {
    EXPECT_FALSE(parseColor(text).has_value()) << '"' << text << '"';
  }
}

TEST(Color, NearestNameOfATypo) {
  EXPECT_EQ(nearestColorName("gren"), "green");
  EXPECT_EQ(nearestColorName("Corn Flower Blue"), "cornflowerblue");
  EXPECT_EQ(nearestColorName("cirmson"), "crimson");
  EXPECT_EQ(nearestColorName("zzzzzzzz"), "");
  EXPECT_EQ(nearestColorName(""), "");
  EXPECT_EQ(nearestColorName(std::string(100000, 'r')), "");
}

} // namespace
} // namespace offstage
