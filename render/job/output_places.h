#pragma once

#include <filesystem>
#include <string_view>

namespace offstage {

struct Scene;

/// Where an option of a command writes to.
struct OutputPlace {
  std::string_view option;   ///< for messages
  std::filesystem::path out; ///< empty or "-": no file
  bool isPattern = false;    ///< of numbered pictures: every name that it may write counts
};

/// Throws Error(BadInput) when the output would replace `other`, which `what` names in the message.
void requireApart(const OutputPlace& output, std::string_view what, const std::filesystem::path& other);

/// The same for every file that the scene is made with: its text, tables, recorded input and dt logs, images,
/// fonts, sounds and the trace that it replays; its panels' too.
void requireApart(const OutputPlace& output, const Scene& scene);

} // namespace offstage
