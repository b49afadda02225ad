#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// npm's playwright-core, where ./dev test puts it.
const std::filesystem::path kPlaywright = OFFSTAGE_SOURCE_DIR "/build/npm/node_modules/playwright-core";
const std::filesystem::path kChromium = "/usr/bin/chromium";
const std::filesystem::path kNode = "/usr/bin/node";

/// Keys, slider, filter, pixel values, no console errors, no request that leaves the folder, a phone.
TEST(ReportInABrowser, DoesWhatItsKeysAndButtonsSay) {
  for (const std::filesystem::path& needed : {kPlaywright, kChromium, kNode})
    if (!std::filesystem::exists(needed)) GTEST_SKIP() << needed << " is missing; ./dev test installs it";
  const TempDir dir;
  for (const char* name : {"a", "b"}) std::filesystem::create_directory(dir / name);
  const std::string a = (dir / "a").string();
  const std::string b = (dir / "b").string();
  const std::string report = (dir / "report").string();
  ASSERT_EQ(
      offstage({"render", scene("exercise2_bounce"), "-o", a + "/f%02d.png", "--from", "8", "--to", "8.1"})
          .status,
      0);
  ASSERT_EQ(
      offstage({"render", scene("exercise2_bounce"), "-o", b + "/f%02d.png", "--from", "8", "--to", "8.1"})
          .status,
      0);
  // Two frames take each other's place, so they differ and the others do not.
  std::filesystem::rename(b + "/f02.png", b + "/f");
  std::filesystem::rename(b + "/f04.png", b + "/f02.png");
  std::filesystem::rename(b + "/f", b + "/f04.png");
  ASSERT_EQ(offstage({"diff", a, b, "--html", report, "--metric", "all"}).status, 1);
  const std::string check = OFFSTAGE_SOURCE_DIR "/tests/browser/report_check.mjs";
  const ProcessResult result =
      runProcess({kNode.string(), check, kPlaywright.string(), kChromium.string(), report});
  EXPECT_EQ(result.status, 0) << result.err << result.out;
}

} // namespace
} // namespace offstage::test
