#pragma once

#include "src/scene/tolerance.h"

#include <string>
#include <vector>

namespace offstage {

/// `[golden]`: which moments of a scene are kept as pictures that later drawings are held to.
struct GoldenMoments {
  std::vector<double> at;    ///< s, each within the clock, in order, each once; not empty
  Tolerance tolerance;       ///< for its pictures
  bool hasTolerance = false; ///< false: the folder's tolerance.toml holds, or none
};

/// The name of a scene's golden: "bounce@2.5s". `seconds` in the shortest form that reads back to the same
/// bits.
std::string goldenName(const std::string& sceneName, double seconds);

} // namespace offstage
