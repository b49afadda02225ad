#pragma once

#include "src/scene/tolerance.h"

#include <string>
#include <vector>

namespace offstage {

/// `[golden]`: which moments of a scene are kept as pictures that later drawings are held to.
struct GoldenMoments {
  /// s, each within the clock, in order, each once; empty only where a command line gives the length.
  std::vector<double> at;
  Tolerance tolerance;       ///< for its pictures
  bool hasTolerance = false; ///< false: the folder's tolerance.toml holds, or none
};

/// The name of a scene's golden: "bounce@2.5s". `seconds` in the shortest form that reads back to the same
/// bits.
std::string goldenName(const std::string& sceneName, double seconds);

} // namespace offstage
