#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace offstage {

/// What the chunks of a render were made from, as lines of `key = value`: equal manifests mean equal chunks.
/// A key may stand more than once.
class Manifest {
public:
  void add(std::string_view key, std::string_view value);
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::vector<std::string> values(std::string_view key) const; ///< in order
  /// The keys whose values differ, "the scene, the options"; empty when the manifests are equal.
  [[nodiscard]] std::string differences(const Manifest& other) const;

  /// Nothing when the text is no manifest.
  static std::optional<Manifest> parse(std::string_view text);
  /// Nothing when there is no file or it is no manifest.
  static std::optional<Manifest> read(const std::filesystem::path& file);

  /// Whether something stands there that is neither a manifest, whole or damaged behind its first line, nor
  /// an empty file.
  static bool isForeign(const std::filesystem::path& file);

  friend bool operator==(const Manifest&, const Manifest&) = default;

private:
  std::vector<std::pair<std::string, std::string>> entries_;
};

} // namespace offstage
