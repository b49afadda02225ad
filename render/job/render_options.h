#pragma once

#include "render/draw/picture.h"
#include "render/job/progress.h"
#include "render/output/quality.h"
#include "src/scene/scene.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace offstage {

/// The I-th of N equal parts of an output's chunks.
struct Segment {
  std::int64_t number = 1; ///< 1 … count
  std::int64_t count = 1;  ///< ≥ 1
};

/// What `offstage render` and a C++ exercise's command line ask for. Absent: as the scene or the exercise has
/// it.
struct RenderOptions {
  std::filesystem::path out;              ///< empty: no frames are kept (only `hashFile`)
  std::optional<std::array<int, 2>> size; ///< px of the output: the pane as large as fits, centred
  std::optional<double> fps;              ///< 1/s: of a fixed clock; of a recorded one: resample to it
  std::optional<double> duration;         ///< s
  std::optional<double> from, to;         ///< s: the part to render
  std::optional<std::filesystem::path> dtLog;
  std::optional<std::filesystem::path> input; ///< a log of recorded input (src/scene/input_log.h)
  std::optional<std::int64_t> seed;
  std::optional<double> scale;    ///< output pixels per scene pixel
  std::optional<Quality> quality; ///< nothing: the format's default
  std::filesystem::path hashFile; ///< a line a frame: `frame state-hash pixel-hash`; empty: none
  std::filesystem::path poster;   ///< a picture of one moment, .png or .jpg; empty: none
  /// Worker processes at a time; 0: everything in this process, without fork. Nothing: as many as there are
  /// processors. The output's bytes do not depend on it. Raw outputs are written by this process alone.
  std::optional<int> jobs;
  std::optional<Segment> segment; ///< render only this part, and leave its chunks in OUT.parts for join
  bool resume = true;             ///< use the chunks that an interrupted run of the same render has left
  bool strict = false;            ///< nothing is made of a run that there is a warning about (warning_log.h)
  ProgressMode progress = ProgressMode::Auto;

  [[nodiscard]] SceneOverrides sceneOverrides() const { return {fps, dtLog, duration, seed, scale, input}; }

  /// Where a pane of this size (px) lies on the output. `scale` is the scene's, already overridden.
  [[nodiscard]] Viewport viewport(double paneWidth, double paneHeight, double sceneScale) const;

  /// The options that change what is drawn, each as a command line has it ("--fps=30"), in a fixed order.
  [[nodiscard]] std::vector<std::string> drawingArguments() const;
};

constexpr int kMostJobs = 1024;
constexpr std::int64_t kMostSegments = 100000;

} // namespace offstage
