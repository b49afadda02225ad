#include "render/draw/image.h"
#include "render/job/still.h"
#include "render/output/atomic_file.h"
#include "render/output/png.h"
#include "src/scene/scene.h"
#include "tests/support/image_compare.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// A picture that was looked at and found right: tests/goldens/SCENE@SECONDSs.png.
struct Golden {
  std::filesystem::path file;
  std::string scene;
  double at = 0.0;
};

Golden goldenOf(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t mark = stem.rfind('@');
  return {file, stem.substr(0, mark), std::stod(stem.substr(mark + 1))};
}

std::vector<std::filesystem::path> filesOf(const std::filesystem::path& folder, const std::string& ending) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ending) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<Golden> goldens() {
  std::vector<Golden> all;
  for (const auto& file : filesOf(OFFSTAGE_SOURCE_DIR "/tests/goldens", ".png"))
    all.push_back(goldenOf(file));
  return all;
}

void write(const std::filesystem::path& path, const Still& still) {
  const std::vector<std::uint8_t> png = encodePng(still.frame, still.alpha);
  AtomicFile file(path);
  file.write(png.data(), png.size());
  file.commit();
}

/// OFFSTAGE_UPDATE_GOLDENS=1 writes what is drawn over the goldens, and fails, so that nothing passes by
/// accident.
bool updating() {
  const char* value = std::getenv("OFFSTAGE_UPDATE_GOLDENS");
  return value != nullptr && std::string(value) == "1";
}

TEST(SceneGolden, EveryScenePicturesItsGoldenPixelByPixel) {
  for (const Golden& golden : goldens()) {
    const Scene scene = loadScene(OFFSTAGE_SOURCE_DIR "/scenes/" + golden.scene + ".toml");
    SceneSource source(scene, Viewport::scaled(scene.size[0], scene.size[1], scene.scale));
    const Still still = drawStill(source, golden.at);
    if (updating()) {
      write(golden.file, still);
      ADD_FAILURE() << "rewrote " << golden.file;
      continue;
    }
    const Image expected = loadImage(golden.file);
    ASSERT_EQ(still.frame.width, expected.width) << golden.file;
    ASSERT_EQ(still.frame.height, expected.height) << golden.file;
    const ImageDifference difference =
        compareImages(still.frame.rgba, expected.rgba, expected.width, expected.height);
    if (difference.differing == 0) continue;
    const std::filesystem::path actual = OFFSTAGE_BINARY_DIR "/golden_actual" / golden.file.filename();
    std::filesystem::create_directories(actual.parent_path());
    write(actual, still);
    ADD_FAILURE() << golden.file << ": " << difference << "; drawn: " << actual;
  }
}

TEST(SceneGolden, EverySceneHasAGolden) {
  const std::vector<Golden> all = goldens();
  for (const auto& file : filesOf(OFFSTAGE_SOURCE_DIR "/scenes", ".toml")) {
    const std::string name = file.stem().string();
    EXPECT_TRUE(std::ranges::any_of(all, [&](const Golden& golden) { return golden.scene == name; }))
        << name << " has none; draw one with offstage still " << file << " --at S -o tests/goldens/" << name
        << "@Ss.png and look at it";
  }
}

} // namespace
} // namespace offstage::test
