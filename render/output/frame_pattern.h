#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace offstage {

/// File names numbered by a printf pattern such as frames/%06d.png. The number's place, %d or %0Nd (at least
/// N digits, N from 1 to 18), stands once in the file's name; %% there is a percent sign. Folders are taken
/// literally.
class FramePattern {
public:
  /// Throws Error(BadInput) when the name has no %d, more than one, or another conversion.
  explicit FramePattern(const std::filesystem::path& pattern);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; } ///< "." for a bare name
  [[nodiscard]] std::filesystem::path path(std::int64_t number) const;
  /// The number of a file's name (without folder) that this pattern makes; nothing for other names.
  [[nodiscard]] std::optional<std::int64_t> numberOf(std::string_view name) const;
  /// Whether the name of some number begins so.
  [[nodiscard]] bool mayBeginWith(std::string_view begin) const;

private:
  std::filesystem::path folder_;
  std::string before_;
  std::string after_;
  int digits_ = 1; ///< at least so many
};

} // namespace offstage
