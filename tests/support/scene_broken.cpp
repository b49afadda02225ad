#include "tests/support/scene_broken.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace offstage::test {
namespace {

void readBrokenScenes(const std::filesystem::path& file, std::vector<BrokenScene>& scenes) {
  enum class Part { None, Text, Errors } part = Part::None;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("== ")) {
      scenes.push_back({line.substr(3), "", {}});
      part = Part::Text;
    } else if (part == Part::None) {
      throw std::runtime_error(file.string() + " must begin with '== '");
    } else if (line == "--") {
      part = Part::Errors;
    } else if (part == Part::Text) {
      scenes.back().text += line + '\n';
    } else {
      scenes.back().errors.push_back(line);
    }
  }
}

} // namespace

std::vector<BrokenScene> brokenScenes() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(OFFSTAGE_SOURCE_DIR "/tests/reference/broken_scenes")) {
    if (entry.path().extension() == ".txt") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<BrokenScene> scenes;
  for (const auto& file : files) readBrokenScenes(file, scenes);
  return scenes;
}

} // namespace offstage::test
