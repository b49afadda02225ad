#pragma once

#include "src/scene/scene.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace offstage::test {

/// Parses a scene as the file "scene.toml" of a folder that holds nothing.
Scene sceneOf(std::string_view text, const SceneOverrides& overrides = {});

/// Every error's text() of such a scene, in order; empty when it has none.
std::vector<std::string> errorsOf(std::string_view text, const SceneOverrides& overrides = {});

/// The example scene of the design's "Scene files", word for word.
std::string_view designScene();

/// A folder of its own, removed with everything in it at the end of the test.
class TemporaryFolder {
public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Writes a file and returns its path.
  std::filesystem::path write(const std::string& name, std::string_view content) const;

private:
  std::filesystem::path path_;
};

} // namespace offstage::test
