#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace offstage {

/// A folder that appears under its name whole or not at all: filled under a temporary name beside it, then
/// renamed. It may take the place of one that it has made before and that nobody has changed since; a list of
/// its files with their hashes,
/// `.offstage`, tells. Anything else under the name is never touched.
class StagedFolder {
public:
  /// Makes the temporary folder. Throws Error(BadInput) when something stands under the name that may not be
  /// replaced, or the folder cannot be made.
  explicit StagedFolder(std::filesystem::path path);
  ~StagedFolder(); ///< removes the temporary folder, or the one that was replaced
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; } ///< to be filled
  /// Writes the list and puts the folder under its name. Once. Throws as the constructor.
  void commit();

private:
  void requireReplaceable() const;

  std::filesystem::path path_; ///< without a slash at its end
  std::filesystem::path temporary_;
};

} // namespace offstage
