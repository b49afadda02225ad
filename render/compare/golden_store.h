#pragma once

#include "render/compare/compare_images.h"
#include "render/compare/golden_lock.h"
#include "render/compare/golden_states.h"
#include "render/compare/report.h"
#include "render/raster/frame.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace offstage {

/// A moment of a scene, just drawn.
struct GoldenPicture {
  std::string name;      ///< "bounce@2.5s"
  std::string sceneName; ///< "bounce"
  Frame frame;
  bool alpha = false;      ///< the background is not opaque
  std::int64_t number = 0; ///< of the frame
  double time = 0.0;       ///< s: of the frame
  std::uint64_t state = 0; ///< state hash
  GoldenMachine machine;
};

enum class GoldenVerdict : std::uint8_t {
  Same,
  PixelsChanged,  ///< beyond the tolerance, while the state is the recorded one
  PhysicsChanged, ///< the state is another one, whatever the pixels
  SizeChanged,
  Missing,  ///< no picture, or no line in goldens.lock
  Obsolete, ///< a golden of which no scene knows
};

/// "same", "pixels changed, physics did not", "physics changed", "size changed", "golden missing", "golden
/// obsolete".
std::string_view name(GoldenVerdict verdict);

/// A verdict, with what to read of it.
struct GoldenFinding {
  GoldenVerdict verdict = GoldenVerdict::Same;
  bool pictureHolds = false;  ///< there is a picture, and it is the same within the tolerance
  ReportCase report;          ///< pictures included when it is not the same
  std::optional<Frame> strip; ///< expected | difference | actual, where both are there and differ
};

/// A folder of goldens: `NAME@Ss.png` a golden, `NAME.states.csv` a scene (see GoldenStates), goldens.lock,
/// and tolerance.toml if there is one.
class GoldenStore {
public:
  /// Throws Error(BadInput) when the folder is none, SceneError for a lock or tolerance that cannot be read.
  explicit GoldenStore(std::filesystem::path folder);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::filesystem::path pictureFile(const std::string& name) const;
  [[nodiscard]] std::filesystem::path statesFile(const std::string& sceneName) const;
  [[nodiscard]] std::filesystem::path lockFile() const { return folder_ / "goldens.lock"; }
  [[nodiscard]] GoldenLock& lock() { return lock_; }

  /// The folder's tolerance in words; scenes may have their own.
  [[nodiscard]] std::string toleranceText() const;

  /// The recorded run of a scene; nothing when there is none.
  [[nodiscard]] std::optional<GoldenStates> states(const std::string& sceneName) const;

  /// Holds a picture to its golden. `tolerance`: the scene's own; null: the folder's. `run`: this run against
  /// the recorded one, up to this frame; nothing when none was recorded. `bodyNames`: by id, for messages.
  /// Throws Error(BadInput) when the golden's file is broken.
  GoldenFinding verify(const GoldenPicture& picture, const Tolerance* tolerance,
                       const std::optional<StatesDifference>& run,
                       const std::vector<std::string>& bodyNames) const;

  /// The goldens that are there, in the lock or as pictures, but not among `wanted`; in order.
  [[nodiscard]] std::vector<std::string> obsolete(const std::set<std::string>& wanted) const;
  GoldenFinding findObsolete(const std::string& name) const;

  /// Whether a golden has a picture.
  [[nodiscard]] bool hasPicture(const std::string& name) const;
  /// Puts a picture, a PNG's bytes, and its line in the golden's place. saveLock() makes the line last.
  void put(const std::string& name, const std::vector<std::uint8_t>& png, const GoldenEntry& entry);
  void putStates(const std::string& sceneName, const std::string& text);
  /// Takes a golden away; its scene's states too, when it was the last one.
  void remove(const std::string& name);
  void saveLock() const { lock_.save(lockFile()); }

private:
  std::filesystem::path folder_;
  GoldenLock lock_;
  std::optional<Tolerance> tolerance_; ///< of tolerance.toml
};

/// "bounce" of "bounce@2.5s".
std::string sceneOfGolden(const std::string& name);

/// What is written for a picture that is put.
GoldenEntry entryOf(const GoldenPicture& picture);

} // namespace offstage
