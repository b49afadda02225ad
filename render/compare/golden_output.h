#pragma once

#include "render/compare/golden_store.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace offstage {

/// What a verification leaves for people to look at, and for `accept` to take over: `out/golden` with
/// NAME.actual.png, NAME.strip.png, the report, and the lines and states of what was drawn.
class GoldenOutput {
public:
  /// Makes the folder, and takes away what an earlier verification left there; nothing else.
  GoldenOutput(std::filesystem::path folder, const std::filesystem::path& goldens);

  /// Keeps what was drawn and is not the same. `states`: the scene's run (GoldenRecorder::text()).
  void keep(const GoldenPicture& picture, const GoldenFinding& finding);
  void keepStates(const std::string& sceneName, const std::string& states);
  void keepObsolete(const std::string& name);
  /// Writes the report and what accept needs. Once, at the end.
  void finish(const Report& report) const;

  [[nodiscard]] std::filesystem::path reportFolder() const { return folder_ / "report"; }

private:
  std::filesystem::path folder_;
  std::string goldens_; ///< the store's folder, absolute
  GoldenLock drawn_;
  std::vector<std::string> obsolete_;
};

/// Takes over what the last verification of `store` left in `folder`: the pictures of these names, or all of
/// them when there are none; obsolete goldens are removed. Returns the names, in order. What was looked at is
/// what is taken: nothing is drawn again. Throws Error(BadInput) when the last verification was of other
/// goldens, or a name is none of what it left.
std::vector<std::string> acceptGoldens(GoldenStore& store, const std::filesystem::path& folder,
                                       const std::vector<std::string>& names);

} // namespace offstage
