#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// A folder, and the folders whose headers it may include beside its own: data flows one way.
struct Layer {
  std::string folder;
  std::vector<std::string> below;
};

const std::vector<Layer>& layers() {
  static const std::vector<Layer> all{
      {"src/sim", {}},
      {"src/scene", {"src/sim"}},
      {"render/draw", {"src/sim", "src/scene"}},
      {"render/raster", {"src/sim", "src/scene", "render/draw"}},
      {"render/output", {"src/sim", "src/scene", "render/draw", "render/raster"}},
      {"render/compare", {"src/sim", "src/scene", "render/draw", "render/raster", "render/output"}},
      {"render/job",
       {"src/sim", "src/scene", "render/draw", "render/raster", "render/output", "render/compare"}},
      {"render/stage",
       {"src/sim", "src/scene", "render/draw", "render/raster", "render/output", "render/compare",
        "render/job"}},
  };
  return all;
}

TEST(IncludeDirection, EveryFolderIncludesOnlyItselfAndWhatStandsBelowIt) {
  const std::filesystem::path root = OFFSTAGE_SOURCE_DIR;
  int includes = 0;
  for (const Layer& layer : layers()) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / layer.folder)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        const std::string start = "#include \"";
        if (!line.starts_with(start)) continue;
        const std::string target = line.substr(start.size(), line.find('"', start.size()) - start.size());
        const std::string folder = std::filesystem::path(target).parent_path().string();
        EXPECT_TRUE(folder == layer.folder || std::ranges::count(layer.below, folder) == 1)
            << entry.path() << " includes " << target;
        ++includes;
      }
    }
  }
  EXPECT_GT(includes, 100);
}

} // namespace
} // namespace offstage::test
