#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace offstage::test {

/// A fresh folder for one test, removed with all that is in it.
class TempDir {
public:
  TempDir();
  ~TempDir();
  TempDir(const TempDir&) = delete;
  TempDir& operator=(const TempDir&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  /// Writes a file into it and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& text) const;
  /// Names of everything in it, hidden files too, sorted; of a folder below it when `folder` is given.
  [[nodiscard]] std::vector<std::string> names(const std::string& folder = ".") const;

private:
  std::filesystem::path path_;
};

std::string readFile(const std::filesystem::path& path);
void writeFile(const std::filesystem::path& path, const std::string& text);

} // namespace offstage::test
