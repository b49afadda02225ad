#pragma once

#include <string>
#include <vector>

namespace offstage::test {

/// A scene with something wrong in it, and everything that must be said about it.
struct BrokenScene {
  std::string name; ///< of the test
  std::string text;
  std::vector<std::string> errors; ///< "line:column: error: message", in order, without the file
};

/// All of tests/reference/broken_scenes/*.txt, one idea each. A file holds any number of them:
///
///     == NameOfTheTest
///     the scene, any number of lines
///     --
///     2:10: error: what must be said, a line each
///
/// Throws std::runtime_error when a file is not of this form.
std::vector<BrokenScene> brokenScenes();

} // namespace offstage::test
