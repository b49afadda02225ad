#pragma once

#include "render/compare/report.h"
#include "render/job/warning_log.h"

#include <filesystem>
#include <string>
#include <vector>

namespace offstage {

/// Where a verification leaves what is to be looked at, unless told otherwise.
inline constexpr const char* kGoldenOut = "out/golden";

/// Where golden frames and their scenes are.
struct GoldenFolders {
  std::filesystem::path goldens; ///< pictures, states, goldens.lock, tolerance.toml
  std::filesystem::path scenes;  ///< the *.toml of this folder with a [golden]; often the same folder
  std::filesystem::path out = kGoldenOut; ///< what a verification leaves
};

/// Draws every golden moment of every scene and holds it to its golden. What is not the same stays in the
/// `out` folder with a report. Throws Error(BadInput) when a scene or golden cannot be read, or no scene has
/// a [golden]; with Strict also when a scene's run has a warning, before anything is written. Warnings are
/// told once a scene.
Report verifyGoldens(const GoldenFolders& folders, WarningLog::Mode mode = WarningLog::Mode::Tell);

/// What a recording did, by name, in order.
struct GoldenRecording {
  std::vector<std::string> recorded;  ///< there was none
  std::vector<std::string> unchanged; ///< the same as before
  std::vector<std::string> differing; ///< not touched: it has another golden, which only accept replaces
};

/// Draws every golden moment and writes those that have no golden yet, into a folder that is made if need be.
/// Throws as verifyGoldens().
GoldenRecording recordGoldens(const GoldenFolders& folders, WarningLog::Mode mode = WarningLog::Mode::Tell);

} // namespace offstage
