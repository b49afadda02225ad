#include "render/draw/font_library.h"
#include "render/draw/text_layout.h"
#include "render/draw/text_painter.h"
#include "render/job/scene_source.h"
#include "src/scene/number_format.h"
#include "src/sim/error.h"
#include "tests/support/process.h"
#include "tests/support/scene_text.h"
#include "tests/support/temp_dir.h"

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::HasSubstr;

std::shared_ptr<const Font> sans() {
  FontLibrary library;
  return library.get({});
}

std::string problemOf(const std::function<void()>& run) {
  try {
    run();
    return "no error";
  } catch (const Error& error) {
    return fmt::format("{}: {}", static_cast<int>(error.code()), error.what());
  }
}

/// The scene's picture at its first frame.
Picture pictureOf(const std::string& text, double scale = 1.0) {
  const Scene scene = sceneOf(text);
  const SceneSource source(scene, Viewport::scaled(scene.size[0], scene.size[1], scale));
  Picture picture;
  source.draw(picture);
  return picture;
}

TEST(NumberFormat, WritesAsPythonAndFmtDo) {
  EXPECT_EQ(NumberFormat().text(0.1), "0.1");
  EXPECT_EQ(NumberFormat().text(12.0), "12");
  EXPECT_EQ(NumberFormat(".1f").text(3.25), "3.2");
  EXPECT_EQ(NumberFormat("7.2f").text(-1.5), "  -1.50");
  EXPECT_EQ(NumberFormat("+.0f").text(4.0), "+4");
  EXPECT_EQ(NumberFormat("*^9.3e").text(1234.5), "1.234e+03");
  EXPECT_EQ(NumberFormat("_<6.1f").text(2.0), "2.0___");
  EXPECT_EQ(NumberFormat("06.1f").text(-2.0), "-002.0");
  EXPECT_EQ(NumberFormat("d").text(2.6), "3");
  EXPECT_EQ(NumberFormat("4d").text(2.0), "   2");
  EXPECT_EQ(NumberFormat(".3g").text(0.00012345), "0.000123");
}

TEST(NumberFormat, WhatIsNoNumberIsADashAndZeroHasNoMinus) {
  EXPECT_EQ(NumberFormat(".2f").text(std::numeric_limits<double>::quiet_NaN()), "–");
  EXPECT_EQ(NumberFormat("5.2f").text(std::numeric_limits<double>::quiet_NaN()), "    –");
  EXPECT_EQ(NumberFormat(".2f").text(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(NumberFormat(".1f").text(-0.04), "0.0");
  EXPECT_EQ(NumberFormat(".1f").text(-0.06), "-0.1");
  EXPECT_EQ(NumberFormat("+.1f").text(-0.0), "+0.0");
  EXPECT_EQ(NumberFormat(".1e").text(-1e-300), "-1.0e-300");
}

TEST(TextLayout, LettersAreKernedAndLinesBroken) {
  const auto font = sans();
  const auto widthOf = [&](std::string_view text) { return layOut(*font, text).width; };
  EXPECT_LT(widthOf("AV"), widthOf("A") + widthOf("V"));
  EXPECT_EQ(widthOf("HH"), 2 * widthOf("H"));
  const TextLayout layout = layOut(*font, "one\r\ntwo\n\nfour");
  ASSERT_EQ(layout.lines.size(), 4U);
  EXPECT_EQ(layout.lines[0].glyphs.size(), 3U);
  EXPECT_EQ(layout.lines[2].glyphs.size(), 0U);
  EXPECT_EQ(layout.width, layout.lines[3].width);
  EXPECT_EQ(layOut(*font, "").lines.size(), 1U);
}

TEST(GposKerning, SaysOfEveryPairWhatTheOlderTableSays) {
  // DejaVu Sans has both tables, so each is held against the other.
  const std::string file = readFile(typefaceFile(Typeface::Sans));
  std::string withoutGpos = file;
  const std::size_t record = withoutGpos.find("GPOS");
  ASSERT_LT(record, 400U);
  withoutGpos.replace(record, 4, "GPOx");
  const auto fontOf = [](const std::string& bytes) {
    return std::make_unique<Font>(std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
  };
  const auto modern = fontOf(file);
  const auto older = fontOf(withoutGpos);
  int kerned = 0;
  for (char32_t a = U'!'; a <= U'~'; ++a) {
    for (char32_t b = U'!'; b <= U'~'; ++b) {
      const int expected = older->kerning(older->glyph(a), older->glyph(b));
      EXPECT_EQ(modern->kerning(modern->glyph(a), modern->glyph(b)), expected)
          << static_cast<char>(a) << static_cast<char>(b);
      kerned += expected != 0 ? 1 : 0;
    }
  }
  EXPECT_GT(kerned, 100);
}

TEST(TextLayout, AMissingGlyphIsNamedWithItsPlace) {
  const auto font = sans();
  EXPECT_EQ(problemOf([&] { layOut(*font, "ok\nx漢"); }),
            "2: the font has no glyph for \"漢\" (U+6F22), line 2, character 2");
  EXPECT_EQ(problemOf([&] { layOut(*font, "a\tb"); }),
            "2: the font has no glyph for \"\\x09\" (U+0009), line 1, character 2");
  EXPECT_THAT(problemOf([&] { layOut(*font, "שלום"); }), HasSubstr("from left to right only"));
  EXPECT_THAT(problemOf([&] { layOut(*font, "a\xff"); }), HasSubstr("is not UTF-8 (byte 2)"));
  EXPECT_THAT(problemOf([&] { layOut(*font, "\xc0\x80"); }), HasSubstr("is not UTF-8 (byte 1)"));
  EXPECT_THAT(problemOf([&] { layOut(*font, "a\xe2\x82"); }), HasSubstr("is not UTF-8 (byte 2)"));
}

TEST(TextPainter, LettersAreEvenlySpacedAtAnySize) {
  for (const double size : {9.0, 12.7, 24.0, 61.3}) {
    TextPainter painter(Viewport::scaled(4000, 200, 1.0));
    Picture picture;
    TextLook look;
    look.size = size;
    look.anchor = NinePosition::Left;
    painter.draw(picture, std::string(40, 'l'), look, Vec2(3.3, 100.2));
    ASSERT_EQ(picture.primitives.size(), 40U);
    const double step = static_cast<double>(layOut(*sans(), "l").width) * size / sans()->unitsPerEm();
    // A letter's middle, from its mask: the mean of its columns by their coverage.
    const auto middle = [&](std::size_t i) {
      const Mask& mask = *picture.masks[i];
      double sum = 0.0;
      double weight = 0.0;
      for (int k = 0; k < mask.width * mask.height; ++k) {
        sum += mask.coverage[static_cast<std::size_t>(k)] * (k % mask.width + 0.5);
        weight += mask.coverage[static_cast<std::size_t>(k)];
      }
      return picture.primitives[i].low.x() + sum / weight;
    };
    for (std::size_t i = 1; i < 40; ++i)
      EXPECT_NEAR(middle(i) - middle(0), static_cast<double>(i) * step, 0.26)
          << "px, letter " << i << " at size " << size << ": each stands on the nearest quarter of a pixel";
  }
}

TEST(TextPainter, EqualLettersShareTheirMasks) {
  TextPainter painter(Viewport::scaled(640, 480, 1.0));
  Picture picture;
  painter.draw(picture, "nnnnnnnnnnnn", {}, Vec2(320, 240));
  std::set<const Mask*> different;
  for (const auto& mask : picture.masks) different.insert(mask.get());
  EXPECT_LE(different.size(), 4U);
}

TEST(TextPainter, MeasuresWhatItDraws) {
  TextPainter painter(Viewport::scaled(640, 480, 2.0));
  TextLook look;
  look.size = 20.0;
  const Vec2 one = painter.measure("mm", look);
  const Vec2 two = painter.measure("mm\nm", look);
  EXPECT_NEAR(one.x(), 2.0 * 0.974 * 20.0, 0.1);
  EXPECT_NEAR(two.y() - one.y(), 1.25 * 20.0, 1e-9);
  look.upwards = true;
  EXPECT_EQ(painter.measure("mm", look).x(), one.y());
}

TEST(Text, FadesInAndOut) {
  const auto alphaAt = [](double time) {
    const Scene scene =
        sceneOf("duration = 10\n[[text]]\ntext = \"l\"\nplace = \"top\"\nfrom = 1\nto = 5\nfade = 2\n");
    return scene.texts.empty() ? -1.0 : shownShare(scene.texts[0], time);
  };
  EXPECT_EQ(alphaAt(0.9), 0.0);
  EXPECT_EQ(alphaAt(1.5), 0.25);
  EXPECT_EQ(alphaAt(3.0), 1.0);
  EXPECT_EQ(alphaAt(4.0), 0.5);
  EXPECT_EQ(alphaAt(5.0), 0.0);
}

TEST(Text, DoesNotComeAfterTheVideosEnd) {
  const auto from = [](const std::string& time, const std::string& more = "") {
    return "duration = 2\n[[text]]\ntext = \"l\"\nplace = \"top\"\nfrom = " + time + "\n" + more;
  };
  EXPECT_THAT(errorsOf(from("2")), ::testing::IsEmpty());
  EXPECT_THAT(
      errorsOf(from("5")),
      ::testing::ElementsAre("scene.toml:5:8: error: 'from' in [[text]] is 5 s, but the video ends at 2 s"));
  // It is the video that counts, and a shorter one that somebody asks for leaves it out.
  EXPECT_THAT(errorsOf(from("5", "[[pause]]\nat = 1\nfor = 4\n")), ::testing::IsEmpty());
  SceneOverrides overrides;
  overrides.duration = 1.0;
  EXPECT_THAT(errorsOf(from("2"), overrides), ::testing::IsEmpty());
}

TEST(Text, FollowsItsBodyAndGoesWithIt) {
  const std::string scene =
      "duration = 2\n[world]\ngravity = [0, 0]\n[[body]]\nname = \"b\"\ncenter = [600, 100]\n"
      "radius = 5\nvelocity = [60, 0]\nleaving = \"remove\"\n"
      "[[text]]\ntext = \"l\"\nat = \"b\"\noffset = [0, 20]\n";
  const Scene parsed = sceneOf(scene);
  SceneSource source(parsed, Viewport::scaled(640, 480, 1.0));
  Picture picture;
  source.draw(picture);
  ASSERT_EQ(picture.primitives.size(), 2U);
  const double before = picture.primitives[1].low.x();
  for (int i = 0; i < 30; ++i) source.step();
  source.draw(picture);
  ASSERT_EQ(picture.primitives.size(), 2U);
  EXPECT_NEAR(picture.primitives[1].low.x() - before, 30.0, 0.51);
  while (source.frame() < source.clock().steps()) source.step();
  source.draw(picture);
  EXPECT_EQ(picture.primitives.size(), 0U);
}

TEST(Text, LeavesTheStateHashAsItIs) {
  const std::string motion =
      "[walls]\nbottom = 0.8\n[[body]]\nname = \"b\"\ncenter = [320, 60]\nradius = 20\n";
  const Scene plain = sceneOf(motion);
  const Scene told = sceneOf(motion + "[[text]]\ntext = \"{b.energy:.1f} {energy}\"\nat = \"b\"\nfade = 1\n");
  SceneSource one(plain, Viewport::scaled(640, 480, 1.0));
  SceneSource two(told, Viewport::scaled(640, 480, 1.0));
  Picture picture;
  for (int frame = 0; frame < 300; ++frame) {
    two.draw(picture);
    ASSERT_EQ(one.stateHash(), two.stateHash()) << "frame " << frame;
    one.step();
    two.step();
  }
}

TEST(Text, OfAReplayKnowsItsGroupsButNoForces) {
  const TempDir dir;
  dir.write(
      "t.csv",
      "frame,time,id,x,y,radius,group\n0,0,3,100,50,2,rain\n1,0.5,3,100,60,2,rain\n1,0.5,4,9,9,2,rain\n");
  const auto sceneWith = [&](const std::string& text) {
    return parseScene("[replay]\ntrace = \"t.csv\"\n[[text]]\nplace = \"top\"\ntext = \"" + text + "\"\n",
                      dir / "s.toml");
  };
  const Scene scene = sceneWith("{rain.count} {#3.y} {t}");
  SceneSource source(scene, Viewport::scaled(640, 480, 1.0));
  EXPECT_EQ(scene.texts.at(0).text.text(source.snapshot()), "1 50 0");
  source.step();
  EXPECT_EQ(scene.texts.at(0).text.text(source.snapshot()), "2 60 0.5");
  EXPECT_THAT(problemOf([&] { sceneWith("{energy}"); }), HasSubstr("a replayed trace has no forces"));
}

TEST(Text, ACharacterThatTheFontLacksIsLocatedInTheScene) {
  const auto problem = [](const std::string& text) {
    return problemOf([&] { pictureOf("[[text]]\nplace = \"top\"\ntext = \"" + text + "\"\n"); });
  };
  EXPECT_EQ(problem("x 漢"),
            "2: scene.toml:3:8: error: 'text' in [[text]]: the font has no glyph for \"漢\" (U+6F22), "
            "line 1, character 3");
  EXPECT_EQ(problem("{t} 漢"),
            "2: scene.toml:3:8: error: 'text' in [[text]]: the font has no glyph for \"漢\" (U+6F22)");
}

TEST(Text, CharactersThatTheFontLacksInPlotsPanelsAndRulersAreLocatedAllAtOnce) {
  const std::string problem = problemOf([&] {
    pictureOf("[[body]]\nname = \"a\"\ncenter = [9, 9]\nradius = 2\n[[plot]]\ny = [\"a.x\", \"a.y\"]\nname = "
              "[\"b\", \"漢\"]\n"
              "title = \"漢\"\nx_label = \"漢\"\n[[ruler]]\nfrom = [0, 0]\nto = [9, 9]\nunit = \"漢\"\n");
  });
  const std::string lacks = "the font has no glyph for \"漢\" (U+6F22), line 1, character 1";
  EXPECT_EQ(problem, "2: scene.toml:5:1: error: 'title' in [[plot]]: " + lacks +
                         "\nscene.toml:5:1: error: the label of x in [[plot]]: " + lacks +
                         "\nscene.toml:5:1: error: the name of a curve in [[plot]]: " + lacks +
                         "\nscene.toml:10:1: error: 'unit' in [[ruler]]: " + lacks);
  EXPECT_EQ(problemOf([&] { pictureOf("[[panel]]\n[[panel]]\ntitle = \"漢\"\n"); }),
            "2: scene.toml:2:1: error: 'title' in [[panel]]: " + lacks);
}

TEST(Text, OfALargerScaleIsSetAtItsOwnSize) {
  const std::string scene = "[[text]]\ntext = \"m\"\nat = [320, 240]\nsize = 20\n";
  const Picture once = pictureOf(scene);
  const Picture thrice = pictureOf(scene, 3.0);
  EXPECT_NEAR(thrice.masks.at(0)->width, 3 * once.masks.at(0)->width, 4);
}

TEST(Text, ABoxLiesBehindOnWholePixels) {
  const Picture picture = pictureOf(
      "[[text]]\ntext = \"m\"\nat = [320.3, 240.4]\nsize = 20\nbackground = \"#ff000080\"\nopacity = 0.5\n");
  ASSERT_EQ(picture.primitives.size(), 2U);
  EXPECT_EQ(picture.primitives[0].kind, Primitive::Kind::Box);
  EXPECT_EQ(picture.primitives[0].color, (Rgba8{255, 0, 0, 64})) << "half of 128/255, rounded down";
  EXPECT_EQ(picture.primitives[0].low, Vec2(picture.primitives[0].low.array().round()));
  EXPECT_EQ(picture.primitives[1].color.a, 127);
}

TEST(Font, ThatIsMissingNamesThePackage) {
  const TempDir dir;
  const auto scene = dir.write("s.toml", "[[text]]\ntext = \"x\"\nplace = \"top\"\n");
  ProcessOptions options;
  options.environment = {{"OFFSTAGE_FONTS", dir.path().string()}};
  const ProcessResult result = offstage({"still", scene, "--at", "0", "-o", dir / "x.png"}, options);
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_THAT(result.err, HasSubstr("DejaVuSans.ttf"));
  EXPECT_THAT(result.err, HasSubstr("fonts-dejavu-core"));
  const ProcessResult doctor = offstage({"doctor"}, options);
  EXPECT_EQ(doctor.status, 3);
  EXPECT_THAT(doctor.out, HasSubstr("install the package fonts-dejavu-core"));
  EXPECT_THAT(offstage({"doctor"}).out, HasSubstr("ok: /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"));
}

TEST(Font, OfTheUsersIsReadBesideTheSceneOrRefusedThere) {
  const TempDir dir;
  const auto errorFor = [&](const std::string& font) {
    const auto scene =
        dir.write("s.toml", "[[text]]\ntext = \"x\"\nplace = \"top\"\nfont = \"" + font + "\"\n");
    const ProcessResult result = offstage({"check", scene});
    return fmt::format("{} {}", result.status, result.err);
  };
  std::filesystem::copy_file(typefaceFile(Typeface::Mono), dir / "mine.ttf");
  EXPECT_EQ(errorFor("mine.ttf"), "0 ");
  dir.write("text.ttf", "this is no font at all");
  EXPECT_THAT(errorFor("text.ttf"), HasSubstr("s.toml:4:8: error: the font " + (dir / "text.ttf").string() +
                                              " is no TrueType or OpenType font"));
  EXPECT_THAT(errorFor("nothing.ttf"), HasSubstr("2 "));
  EXPECT_THAT(errorFor("nothing.ttf"), HasSubstr("4:8: error: 'font' in [[text]] names the file"));
  EXPECT_THAT(errorFor("sons"), HasSubstr("did you mean \"sans\"?"));
  EXPECT_THAT(errorFor("./"), HasSubstr("which is no regular file"));
}

/// Whether a font of these bytes draws its letters, and is not refused. It may do no third thing.
bool draws(const std::string& bytes) {
  try {
    const Font font(std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
    GlyphCache cache;
    for (const char32_t c : U"AVgé8") {
      const std::uint32_t glyph = font.glyph(c);
      if (glyph == 0) continue;
      static_cast<void>(font.advance(glyph) + font.kerning(glyph, glyph));
      static_cast<void>(cache.get({&font, glyph, 20.0, 0.0, 0, 0, false}));
    }
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

TEST(Font, ThatIsCutOffAnywhereIsDrawnOrRefused) {
  const std::string font = readFile(typefaceFile(Typeface::Mono));
  EXPECT_TRUE(draws(font));
  for (std::size_t length = 0; length < font.size(); length += 1 + length / 8) {
    const bool drawn = draws(font.substr(0, length));
    EXPECT_FALSE(drawn && length < 10000) << length << " bytes";
  }
}

TEST(Font, WithWrongBytesIsDrawnOrRefused) {
  const std::string font = readFile(typefaceFile(Typeface::Mono));
  std::mt19937 random(3);
  int drawn = 0;
  for (int round = 0; round < 150; ++round) {
    std::string damaged = font;
    // Half of the rounds hit the tables' directory and what stands first, where lengths and offsets are.
    const std::size_t reach = round % 2 == 0 ? std::size_t{2048} : damaged.size();
    for (int k = 0; k < 1 + round % 20; ++k) damaged[random() % reach] = static_cast<char>(random() & 0xffU);
    drawn += draws(damaged) ? 1 : 0;
  }
  EXPECT_GT(drawn, 50) << "of 150";
  EXPECT_LT(drawn, 150) << "of 150";
}

} // namespace
} // namespace offstage::test
