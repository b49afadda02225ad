#pragma once

#include "src/scene/trace_compare.h"
#include "src/sim/body.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace offstage {

/// How a scene with goldens moved when they were recorded: enough to say later in which frame, in which body
/// and by how much the physics changed, and little enough to be kept beside the pictures.
///
/// The file is a trace, with remarks before it:
///
///     # offstage golden states 1: frames 0 to 600, stride 1, and 90 600
///     # hashes of frame 0: 1f8a03 77c02e …
///
/// The hashes are the low 24 bits of each frame's state hash. The rows are those of every `stride`-th frame
/// and of the goldens' frames. The stride is the smallest power of two that leaves at most 1000 rows (those
/// of the goldens' own frames not counted), so a few balls are kept whole and a crowd by samples.
struct GoldenStates {
  std::vector<std::uint32_t> hashes; ///< by frame, from 0
  std::int64_t stride = 1;
  std::vector<std::int64_t> also; ///< frames that are kept beside the stride's, in order
  Trace trace;

  [[nodiscard]] bool keeps(std::int64_t frame) const;
};

/// Reads such a file. Throws SceneError, located, when it is none.
GoldenStates readGoldenStates(const std::filesystem::path& file);
/// The same from text; `file` is used in messages.
GoldenStates parseGoldenStates(std::string_view text, const std::filesystem::path& file);

/// Collects the states of a run, frame by frame from frame 0.
class GoldenRecorder {
public:
  /// `goldenFrames`: whose rows are always kept.
  GoldenRecorder(std::vector<std::string> groups, std::vector<std::int64_t> goldenFrames);

  void add(std::int64_t frame, double time, std::uint64_t stateHash, std::span<const Body> bodies);

  /// The file's text for what was added so far.
  [[nodiscard]] std::string text() const;

private:
  struct Kept {
    double time = 0.0;
    std::vector<Body> bodies;
  };

  std::vector<std::string> groups_;
  std::vector<std::int64_t> goldenFrames_;
  std::vector<std::uint32_t> hashes_;
  std::map<std::int64_t, Kept> kept_; ///< by frame: those of the stride
  std::map<std::int64_t, Kept> goldens_;
  std::int64_t stride_ = 1;
  std::size_t rows_ = 0; ///< in kept_
};

/// What changed between the recorded run and this one.
struct StatesDifference {
  std::optional<std::int64_t> firstFrame; ///< whose state hash differs; nothing when none does
  TraceComparison comparison;             ///< of the frames that were kept
};

/// Compares a run with a recorded one while it goes.
class StatesWatch {
public:
  /// `recorded` must outlive the watch.
  explicit StatesWatch(const GoldenStates& recorded) : recorded_(recorded) { actual_.hasVelocity = true; }

  /// The next frame of the run, from 0.
  void add(std::int64_t frame, double time, std::uint64_t stateHash, std::span<const Body> bodies);
  /// As far as the run has got.
  [[nodiscard]] StatesDifference difference() const;

private:
  const GoldenStates& recorded_;
  std::optional<std::int64_t> firstFrame_;
  Trace actual_; ///< of the frames that were recorded
};

} // namespace offstage
