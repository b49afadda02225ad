#include "tests/support/bundle_scene.h"
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

/// The video plays with sound, captions come in their time, chapters lead to theirs, nothing is loaded from
/// elsewhere.
TEST(BundleInABrowser, PlaysWithCaptionsAndChapters) {
  for (const std::filesystem::path& needed : {kPlaywright, kChromium, kNode})
    if (!std::filesystem::exists(needed)) GTEST_SKIP() << needed << " is missing; ./dev test installs it";
  const TempDir dir;
  const std::string scene = dir.write("lecture.toml", kBundleScene).string();
  const std::string out = (dir / "out").string();
  ASSERT_EQ(offstage({"bundle", scene, "-o", out, "--progress", "none"}).status, 0);
  const std::string check = OFFSTAGE_SOURCE_DIR "/tests/browser/bundle_check.mjs";
  const ProcessResult result =
      runProcess({kNode.string(), check, kPlaywright.string(), kChromium.string(), out});
  EXPECT_EQ(result.status, 0) << result.err << result.out;
}

} // namespace
} // namespace offstage::test
