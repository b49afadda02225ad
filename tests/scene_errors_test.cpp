#include "src/scene/scene.h"
#include "src/scene/toml_depth.h"
#include "tests/support/scene_broken.h"
#include "tests/support/scene_text.h"
#include "tests/support/temp_dir.h"

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

using test::errorsOf;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;

class BrokenScene : public ::testing::TestWithParam<test::BrokenScene> {};

TEST_P(BrokenScene, SaysExactlyThis) {
  std::vector<std::string> wanted;
  for (const std::string& error : GetParam().errors) wanted.push_back("scene.toml:" + error);
  EXPECT_THAT(errorsOf(GetParam().text), ElementsAreArray(wanted)) << GetParam().text;
}

INSTANTIATE_TEST_SUITE_P(SceneErrors, BrokenScene, ::testing::ValuesIn(test::brokenScenes()),
                         [](const auto& param) { return param.param.name; });

TEST(SceneErrors, ThereAreManyBrokenScenesAndEachNamesAnError) {
  EXPECT_GE(test::brokenScenes().size(), 140U);
  for (const test::BrokenScene& scene : test::brokenScenes())
    EXPECT_FALSE(scene.errors.empty()) << scene.name;
}

TEST(SceneErrors, BytesThatAreNoText) {
  EXPECT_THAT(errorsOf("title = \"a\xff\"\n"),
              ElementsAre("scene.toml:1:10: error: not valid TOML: Encountered invalid utf-8 sequence"));
  EXPECT_THAT(
      errorsOf("\x7f"
               "ELF\x02\x01\n"),
      ElementsAre("scene.toml:1:1: error: not valid TOML: Error while parsing root table: expected keys, "
                  "tables, whitespace or comments, saw '\\u007F'"));
  EXPECT_THAT(
      errorsOf(std::string_view("title = \"a\0\"", 12)),
      ElementsAre("scene.toml:1:11: error: not valid TOML: Error while parsing string: unescaped control "
                  "characters other than TAB (U+0009) are explicitly prohibited"));
}

TEST(SceneErrors, HeadersThatBeginWithNoKey) {
  const auto saw = [](const char* place, const char* what) {
    return ElementsAre(std::string("scene.toml:") + place +
                       ": error: not valid TOML: Error while parsing key: expected bare key starting "
                       "character or string delimiter, saw '" +
                       what + "'");
  };
  EXPECT_THAT(errorsOf("[+[spawn]]\n"), saw("1:2", "+"));
  EXPECT_THAT(errorsOf("[[ =body]]\n"), saw("1:4", "="));
  EXPECT_THAT(errorsOf("[\n"), saw("1:2", "\\n"));
  EXPECT_THAT(errorsOf("[ Ж]\n"), saw("1:3", "Ж"));
}

TEST(SceneErrors, LettersBeyondAsciiAreNoWhiteSpace) {
  EXPECT_EQ(test::sceneOf("title = \"\"\"\\\n  Übung \\\n  Жук\"\"\"\n").title, "Übung Жук");
  EXPECT_THAT(errorsOf("title Ö = 1\n"),
              ElementsAre("scene.toml:1:7: error: not valid TOML: Error while parsing key-value pair: "
                          "expected '=', saw 'Ö'"));
}

std::string whatOf(const std::filesystem::path& file) {
  try {
    static_cast<void>(loadScene(file));
    return "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput);
    return error.what();
  }
}

TEST(SceneErrors, AllErrorsOfAFileInTheOrderOfItsLines) {
  // The parser reads forces last and [frame] first, whatever the order in the file.
  EXPECT_THAT(
      errorsOf("[[force]]\ntype = \"drag\"\nlinear = -1\n\n"
               "[[body]]\nradius = -2\nmas = 3\n\n"
               "[frame]\nscale = \"x\"\n"
               "[clock]\nfps = nan\n"),
      ElementsAre("scene.toml:3:10: error: 'linear' in [[force]] must be at least 0, but it is -1",
                  "scene.toml:5:1: error: [[body]] needs 'center'",
                  "scene.toml:6:10: error: 'radius' in [[body]] must be at least 0, but it is -2",
                  "scene.toml:7:1: error: unknown key 'mas' in [[body]]; did you mean 'mass'?",
                  "scene.toml:10:9: error: 'scale' in [frame] must be a number, but it is the string \"x\"",
                  "scene.toml:12:7: error: 'fps' in [clock] must be a finite number, but it is nan"));
}

/// What other programs, or other tables, call it.
TEST(SceneErrors, AnUnknownKeyThatIsCalledSoElsewhereNamesTheOneThatIsMeant) {
  struct Case {
    const char* table;
    const char* wrong;
    const char* meant;
  };
  for (const auto& [table, wrong, meant] :
       {Case{"[[body]]", "color", "fill"},      Case{"[[body]]", "colour", "fill"},
        Case{"[[bodies]]", "color", "fill"},    Case{"[[spawn]]", "color", "fill"},
        Case{"[[launch]]", "color", "fill"},    Case{"[[text]]", "fill", "color"},
        Case{"[[text]]", "colour", "color"},    Case{"[[trail]]", "colour", "color"},
        Case{"[[plot]]", "colour", "color"},    Case{"[frame]", "colour", "background"},
        Case{"[frame]", "color", "background"}, Case{"[[launch]]", "to", "toward"},
        Case{"[[body]]", "vx", "velocity"},     Case{"[[body]]", "vy", "velocity"},
        Case{"[[body]]", "x", "center"},        Case{"[[body]]", "y", "center"},
        Case{"[[body]]", "width", "size"},      Case{"[[body]]", "height", "size"},
        Case{"[[text]]", "position", "at"},     Case{"[[spawn]]", "max", "limit"},
        Case{"[[pause]]", "duration", "for"},   Case{"[[camera]]", "duration", "for"},
        Case{"[[caption]]", "at", "from"}}) {
    EXPECT_THAT(
        errorsOf(fmt::format("{}\n{} = 1\n", table, wrong)),
        ::testing::Contains(fmt::format("scene.toml:2:1: error: unknown key '{}' in {}; did you mean '{}'?",
                                        wrong, table, meant)));
  }
  EXPECT_THAT(errorsOf("[[body]]\ncenter = [0, 0]\nradius = 1\nstroke = { colour = \"red\" }\n"),
              ElementsAre("scene.toml:4:12: error: unknown key 'stroke.colour' in [[body]]; did you mean "
                          "'stroke.color'?"));
}

TEST(SceneErrors, WhatHoldsOneErrorALineAndTheExitCodeIsBadInput) {
  try {
    static_cast<void>(test::sceneOf("a = 1\nb = 2\n"));
    ADD_FAILURE() << "no error";
  } catch (const SceneError& error) {
    EXPECT_EQ(error.code(), ExitCode::BadInput);
    ASSERT_EQ(error.diagnostics().size(), 2U);
    EXPECT_EQ(error.what(), error.diagnostics()[0].text() + '\n' + error.diagnostics()[1].text());
    EXPECT_EQ(error.diagnostics()[1].where.file, "scene.toml");
    EXPECT_EQ(error.diagnostics()[1].where.line, 2U);
  }
}

TEST(SceneErrors, ErrorsOfADtLogNameTheLog) {
  const test::TempDir folder;
  const auto log = folder.write("a.dt", "1\nx\n");
  const auto scene = folder.write("a.toml", "[clock]\nrecorded = \"a.dt\"\nfsp = 3\n");
  EXPECT_EQ(whatOf(scene), scene.string() +
                               ":3:1: error: unknown key 'fsp' in [clock]; did you mean 'fps'?\n" +
                               log.string() + ":2:1: error: \"x\" is not a whole number of nanoseconds");
}

TEST(SceneErrors, FilesThatAreNoScene) {
  const test::TempDir folder;
  EXPECT_EQ(whatOf(folder.path()), folder.path().string() + ": error: this is a folder, not a scene");
  const auto missing = folder.path() / "none.toml";
  EXPECT_EQ(whatOf(missing), missing.string() + ": error: cannot be read: No such file or directory");
  const auto large = folder.write("large.toml", "");
  std::filesystem::resize_file(large, 100'000'000);
  EXPECT_EQ(whatOf(large), large.string() + ": error: a scene may hold at most 8388608 bytes");
  EXPECT_EQ(whatOf("/dev/zero"), "/dev/zero: error: a scene may hold at most 8388608 bytes");
}

TEST(SceneErrors, DeepNestingIsRefusedBeforeItOverflowsTheStack) {
  std::string dots = "a";
  for (int i = 0; i < 100000; ++i) dots += ".a";
  EXPECT_THAT(errorsOf(dots + " = 1\n"),
              ElementsAre("scene.toml:1:34: error: a key may have at most 16 dots"));
  EXPECT_THAT(errorsOf("x = 'a.b'\n# 'it\ny = \"\"\"\n\"'\"\"\"\n[" + dots + "]\n"),
              ElementsAre("scene.toml:5:35: error: a key may have at most 16 dots"));
  const std::string tooNested = "scene.toml:1:21: error: values may be nested at most 16 deep";
  EXPECT_THAT(errorsOf("a = " + std::string(100000, '[')), ElementsAre(tooNested));
  EXPECT_THAT(errorsOf("a = " + std::string(17, '[') + std::string(17, ']')), ElementsAre(tooNested));
  // Both at their limits, which multiply.
  std::string text = "a";
  std::string end;
  for (std::size_t i = 0; i < kMaxNestedValues; ++i) {
    for (std::size_t dot = 0; dot < kMaxDotsInKey; ++dot) text += ".a";
    text += " = {" + std::string("a");
    end += '}';
  }
  EXPECT_EQ(errorsOf(text + " = 1" + end + "\n").size(), 1U);
}

TEST(SceneErrors, DotsOfTextAreNotThoseOfKeys) {
  const std::string dots(200, '.');
  EXPECT_EQ(test::sceneOf("# " + dots + "\ntitle = \"" + dots + "\\\"" + dots + "\"\n").title,
            dots + '"' + dots);
  EXPECT_EQ(test::sceneOf("title = '''\n" + dots + "\n" + dots + "''' # " + dots).title, dots + '\n' + dots);
}

TEST(SceneErrors, ThereAreNeverMoreThanAThousand) {
  std::string text;
  for (int i = 0; i < 20000; ++i) text += "[[launch]]\n";
  EXPECT_EQ(errorsOf(text).size(), 1000U);
}

TEST(SceneErrors, ForcesAreLimited) {
  std::string text;
  for (int i = 0; i < 10000; ++i) text += "[[force]]\ntype = \"drag\"\n";
  EXPECT_EQ(test::sceneOf(text).world.forces.size(), 10000U);
  EXPECT_THAT(errorsOf(text + "[[force]]\ntype = \"drag\"\n"),
              ElementsAre("scene.toml:20001:1: error: a scene may have at most 10000 [[force]]"));
}

/// Whatever is parsed ends with a scene or with located errors; anything else (a crash, another exception)
/// fails.
void parseSafely(const std::string& text) {
  try {
    static_cast<void>(test::sceneOf(text));
  } catch (const SceneError& error) {
    ASSERT_FALSE(error.diagnostics().empty()) << text;
    for (const Diagnostic& diagnostic : error.diagnostics()) {
      ASSERT_EQ(diagnostic.message.find('\n'), std::string::npos) << diagnostic.message;
      ASSERT_EQ(diagnostic.message.find('\x1b'), std::string::npos) << diagnostic.message;
    }
  }
}

std::string richScene() {
  return std::string(test::designScene()) +
         "linear = 0.1\n[view]\npixels_per_metre = 2\ny_up = true\n[[body]]\nname = \"sun\"\nshape = "
         "\"rectangle\"\n"
         "position = [1, 2]\nsize = [3, 4]\nfill = \"#12345678\"\n[[force]]\ntype = \"expression\"\n"
         "fx = \"sin(x)^2 + (t > 1 ? vy : -m)\"\n[[force]]\ntype = \"spring\"\nto = \"sun\"\nstiffness = 2\n";
}

TEST(SceneErrors, TruncatedScenesNeverCrash) {
  const std::string scene = richScene();
  for (std::size_t length = 0; length < scene.size(); length += 3) parseSafely(scene.substr(0, length));
}

TEST(SceneErrors, ScenesWithFlippedBytesNeverCrash) {
  const std::string scene = richScene();
  constexpr std::string_view kPunctuation = "[]{}=.\"'#,-09\n e"; // what breaks TOML in more interesting ways
  std::mt19937 random(2022);
  for (int round = 0; round < 2000; ++round) {
    std::string text = scene;
    for (auto flips = random() % 4 + 1; flips > 0; --flips) {
      const char anyByte = static_cast<char>(random() % 256);
      const char punctuation = kPunctuation[random() % kPunctuation.size()];
      text[random() % text.size()] = random() % 4 == 0 ? anyByte : punctuation;
    }
    parseSafely(text);
  }
}

TEST(SceneErrors, ScenesWithShuffledLinesNeverCrash) {
  const std::string scene = richScene();
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < scene.size();) {
    const std::size_t end = scene.find('\n', begin);
    lines.push_back(scene.substr(begin, end - begin + 1));
    begin = end + 1;
  }
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    std::string text;
    for (int i = 0; i < 30; ++i) text += lines[random() % lines.size()];
    parseSafely(text);
  }
}

} // namespace
} // namespace offstage
