#pragma once

#include "render/draw/picture.h"
#include "render/job/progress.h"
#include "src/scene/scene.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace offstage {

/// What `offstage render` and a C++ exercise's command line ask for. Absent: as the scene or the exercise has
/// it.
struct RenderOptions {
  std::filesystem::path out;              ///< empty: no frames are kept (only `hashFile`)
  std::optional<std::array<int, 2>> size; ///< px of the output: the pane as large as fits, centred
  std::optional<double> fps;              ///< 1/s: of a fixed clock; of a recorded one: resample to it
  std::optional<double> duration;         ///< s
  std::optional<double> from, to;         ///< s: the part to render
  std::optional<std::filesystem::path> dtLog;
  std::optional<std::int64_t> seed;
  std::optional<double> scale;    ///< output pixels per scene pixel
  std::filesystem::path hashFile; ///< a line a frame: `frame state-hash pixel-hash`; empty: none
  ProgressMode progress = ProgressMode::Auto;

  [[nodiscard]] SceneOverrides sceneOverrides() const { return {fps, dtLog, duration, seed, scale}; }

  /// Where a pane of this size (px) lies on the output. `scale` is the scene's, already overridden.
  [[nodiscard]] Viewport viewport(double paneWidth, double paneHeight, double sceneScale) const;
};

} // namespace offstage
