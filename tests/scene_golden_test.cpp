#include "render/draw/image.h"
#include "render/stage/include/offstage/testing.h"
#include "tests/support/process.h"
#include "tests/support/scene_names.h"
#include "tests/support/temp_dir.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

std::vector<std::string> stemsIn(const std::filesystem::path& folder, const std::string& ending) {
  std::vector<std::string> stems;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ending) stems.push_back(entry.path().stem().string());
  std::sort(stems.begin(), stems.end());
  return stems;
}

/// tests/goldens/SCENE@SECONDSs.png: pictures that were looked at and found right.
std::vector<std::string> goldens() {
  return stemsIn(OFFSTAGE_SOURCE_DIR "/tests/goldens", ".png");
}

std::string sceneOf(const std::string& golden) {
  return golden.substr(0, golden.rfind('@'));
}

TEST(SceneGolden, EveryScenePicturesItsGoldenPixelByPixel) {
  setGoldenFolder(OFFSTAGE_SOURCE_DIR "/tests/goldens");
  setGoldenOutFolder(OFFSTAGE_BINARY_DIR "/golden_actual");
  for (const std::string& golden : goldens()) {
    if (!canBeDrawn(sceneOf(golden))) continue;
    const double at = std::stod(golden.substr(golden.rfind('@') + 1));
    EXPECT_THAT(sceneFrame(scene(sceneOf(golden)), at), MatchesGolden(golden));
  }
  setGoldenFolder("");
  setGoldenOutFolder("");
}

TEST(SceneGolden, ManyMomentsInOnePictureAreTheirGolden) {
  setGoldenFolder(OFFSTAGE_SOURCE_DIR "/tests/goldens/strobe");
  setGoldenOutFolder(OFFSTAGE_BINARY_DIR "/golden_actual/strobe");
  const TempDir dir;
  const ProcessResult drawn =
      offstage({"still", scene("projectiles"), "--at", "7", "--strobe", "21", "-o", dir / "x.png"});
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  const Image picture = loadImage(dir / "x.png");
  Frame frame;
  frame.width = picture.width;
  frame.height = picture.height;
  frame.rgba = picture.rgba;
  EXPECT_THAT(frame, MatchesGolden("projectiles@7s"));
  setGoldenFolder("");
  setGoldenOutFolder("");
}

TEST(SceneGolden, EverySceneHasAGolden) {
  const std::vector<std::string> all = goldens();
  for (const std::string& name : stemsIn(OFFSTAGE_SOURCE_DIR "/scenes", ".toml")) {
    EXPECT_TRUE(std::ranges::any_of(all, [&](const std::string& golden) { return sceneOf(golden) == name; }))
        << name << " has none; draw one with offstage still " << scene(name) << " --at S -o tests/goldens/"
        << name << "@Ss.png and look at it";
  }
}

} // namespace
} // namespace offstage::test
