#include "render/draw/formula.h"
#include "src/sim/error.h"
#include "tests/support/process.h"
#include "tests/support/scene_text.h"
#include "tests/support/temp_dir.h"

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class Formula : public ::testing::Test {
protected:
  void SetUp() override {
    if (texPrograms().empty()) GTEST_SKIP() << "TeX is not installed: " << kTexPackages;
  }

  [[nodiscard]] FormulaCache cache() const { return FormulaCache(folder_ / "cache"); }
  [[nodiscard]] const TempDir& folder() const { return folder_; }
  [[nodiscard]] std::string problemOf(const std::string& formula) const {
    try {
      static_cast<void>(typeset(formula, 30.0, cache()));
      return "no error";
    } catch (const Error& error) {
      return fmt::format("{}: {}", static_cast<int>(error.code()), error.what());
    }
  }

private:
  TempDir folder_;
};

/// PATH with another value while it lives.
class PathOf {
public:
  explicit PathOf(const char* value) {
    if (const char* before = std::getenv("PATH")) before_ = before;
    setenv("PATH", value, 1);
  }
  ~PathOf() { setenv("PATH", before_.c_str(), 1); }
  PathOf(const PathOf&) = delete;
  PathOf& operator=(const PathOf&) = delete;

private:
  std::string before_;
};

TEST_F(Formula, CapitalsAreAsHighAsThoseOfATextOfItsSize) {
  const Mask mask = typeset("H", 100.0, cache());
  EXPECT_NEAR(mask.height, 72.9, 1.6) << "px";
  EXPECT_GT(std::accumulate(mask.coverage.begin(), mask.coverage.end(), 0), 255 * 500);
}

TEST_F(Formula, IsKeptInTheCacheAndThenNeedsNoTex) {
  const std::string formula = "\\frac{1}{2} m v^2";
  const Mask first = typeset(formula, 30.0, cache());
  const PathOf none("");
  EXPECT_EQ(typeset(formula, 30.0, cache()).coverage, first.coverage);
  EXPECT_EQ(problemOf("x"), "3: a formula is typeset by latex, which is missing; install the packages "
                            "texlive-latex-base and dvipng");
}

TEST_F(Formula, ADamagedCacheEntryIsMadeAnew) {
  const Mask first = typeset("x", 30.0, cache());
  const std::vector<std::string> entries = folder().names("cache");
  ASSERT_EQ(entries.size(), 1U);
  const std::filesystem::path entry = folder() / "cache" / entries.front();
  const std::string whole = readFile(entry);
  for (const std::size_t length : {std::size_t{0}, std::size_t{10}, whole.size() / 2, whole.size() - 1}) {
    writeFile(entry, whole.substr(0, length));
    EXPECT_EQ(typeset("x", 30.0, cache()).coverage, first.coverage) << length << " bytes";
    EXPECT_EQ(readFile(entry), whole);
  }
}

TEST_F(Formula, WithoutAFolderForTheCacheIsTypesetAllTheSame) {
  writeFile(folder() / "file", "in the way");
  EXPECT_GT(typeset("x", 30.0, FormulaCache(folder() / "file")).width, 5);
  EXPECT_GT(typeset("x", 30.0, FormulaCache("")).width, 5);
}

TEST_F(Formula, ThatIsWrongIsRefusedInTexsWords) {
  EXPECT_EQ(problemOf("a + \\nosuch b"), "2: TeX says: Undefined control sequence. after \"a + \\nosuch\"");
  EXPECT_THAT(problemOf("\\frac{1"), StartsWith("2: TeX says: "));
  EXPECT_THAT(problemOf("x}"), StartsWith("2: "));
  EXPECT_THAT(problemOf("a_1_2"), HasSubstr("Double subscript"));
  EXPECT_EQ(problemOf("{}"), "2: it shows nothing");
  EXPECT_EQ(problemOf("\\font\\f=ecrm1000 \\hbox{\\f A}"),
            "2: it asks for a font of TeX's that is not installed");
  EXPECT_EQ(problemOf("x % a comment"), "no error");
}

TEST_F(Formula, ReadsAndWritesNothingElsewhereAndRunsNothing) {
  const std::string secret = folder().write("secret.tex", "42").string();
  const std::string target = (folder() / "written.txt").string();
  EXPECT_THAT(problemOf("\\input{" + secret + "}"), StartsWith("2: "));
  EXPECT_THAT(problemOf("\\input{../" + folder().path().filename().string() + "/secret}"), StartsWith("2: "));
  EXPECT_THAT(problemOf("\\newread\\f \\openin\\f=" + secret + " \\ifeof\\f\\undefined\\fi x"),
              StartsWith("2: "));
  EXPECT_THAT(problemOf("\\newwrite\\f \\immediate\\openout\\f=" + target + " \\immediate\\write\\f{x} x"),
              StartsWith("2: "));
  static_cast<void>(problemOf("\\immediate\\write18{touch " + target + "} x"));
  static_cast<void>(problemOf("\\special{ps: (" + target + ") (w) file closefile} x"));
  static_cast<void>(problemOf("\\special{psfile=\"`touch " + target + "\"} x"));
  static_cast<void>(problemOf("\\font\\f=\"|touch " + target + "\" x"));
  EXPECT_FALSE(std::filesystem::exists(target));
}

TEST_F(Formula, ThatNeverEndsIsStopped) {
  EXPECT_THAT(problemOf("\\loop\\iftrue\\repeat"),
              AllOf(StartsWith("2: "), HasSubstr("too much time or memory")));
  EXPECT_THAT(problemOf("\\def\\x{\\x\\x}\\x"), StartsWith("2: "));
  EXPECT_THAT(problemOf("\\rule{16000pt}{16000pt}"), StartsWith("2: "));
}

TEST_F(Formula, OfASceneIsDrawnOrLocated) {
  const auto scene = folder().write(
      "s.toml",
      "[[text]]\nformula = 'x'\nplace = \"top\"\n[[text]]\nformula = '\\nosuch'\nplace = \"top\"\n");
  ProcessOptions options;
  options.environment = {{"XDG_CACHE_HOME", folder().path().string()}};
  const ProcessResult wrong = offstage({"check", scene}, options);
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err,
              HasSubstr("s.toml:5:11: error: 'formula' in [[text]]: TeX says: Undefined control sequence."));
  EXPECT_TRUE(std::filesystem::exists(folder() / "offstage/formulas"));
}

TEST(FormulaText, ThatAnEscapeHasChangedIsRefused) {
  for (const auto& [formula, code] : {std::pair{"\\theta", "U+0009"},
                                      {"x \\times y", "U+0009"},
                                      {"\\frac{1}{2}", "U+000C"},
                                      {"\\beta", "U+0008"}})
    EXPECT_THAT(errorsOf("[[text]]\nformula = \"" + std::string(formula) + "\"\nplace = \"top\"\n"),
                ::testing::ElementsAre(AllOf(HasSubstr(code), HasSubstr("write it in single ones"))))
        << formula;
  EXPECT_THAT(errorsOf("[[text]]\nformula = '\\theta'\nplace = \"top\"\n"), ::testing::IsEmpty());
}

TEST(FormulaWithoutTex, IsStatus3NamingThePackages) {
  const TempDir dir;
  const auto scene = dir.write("s.toml", "[[text]]\nformula = 'x'\nplace = \"top\"\n");
  ProcessOptions options;
  options.environment = {{"XDG_CACHE_HOME", dir.path().string()}, {"PATH", ""}};
  const ProcessResult result = offstage({"still", scene, "--at", "0", "-o", dir / "x.png"}, options);
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_THAT(result.err, HasSubstr("install the packages texlive-latex-base and dvipng"));
  EXPECT_THAT(offstage({"doctor"}, options).out, HasSubstr("none; for formulas install texlive-latex-base"));
  EXPECT_FALSE(std::filesystem::exists(dir / "x.png"));
}

TEST(FormulaCache, IsSharedByWritersAndReaders) {
  const TempDir dir;
  const FormulaCache cache(dir.path());
  Mask mask{300, 200, std::vector<std::uint8_t>(60000, 77)};
  std::atomic<int> torn{0};
  std::vector<std::thread> threads;
  threads.reserve(4);
  for (int k = 0; k < 4; ++k) {
    threads.emplace_back([&] {
      for (int i = 0; i < 100; ++i) {
        cache.put("content", mask);
        const auto found = cache.find("content");
        if (!found || found->coverage != mask.coverage) ++torn;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(dir.names().size(), 1U) << "nothing is left beside the entry";
  EXPECT_FALSE(cache.find("content ").has_value());
}

} // namespace
} // namespace offstage::test
