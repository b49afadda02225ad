#include "tests/support/scene_names.h"

#include "render/draw/formula.h"
#include "tests/support/temp_dir.h"

#include <algorithm>
#include <filesystem>

namespace offstage::test {

bool canBeDrawn(const std::string& name) {
  static const bool hasTex = !texPrograms().empty();
  return hasTex ||
         readFile(OFFSTAGE_SOURCE_DIR "/scenes/" + name + ".toml").find("\nformula") == std::string::npos;
}

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(OFFSTAGE_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::erase_if(names, [](const std::string& name) { return !canBeDrawn(name); });
  std::sort(names.begin(), names.end());
  return names;
}

} // namespace offstage::test
