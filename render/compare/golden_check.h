#pragma once

#include "render/raster/frame.h"
#include "src/scene/tolerance.h"

#include <filesystem>
#include <string>
#include <vector>

namespace offstage {

/// Whether a frame is what a test expects, and what the test says when it is not.
struct FrameCheck {
  bool passed = false;
  std::string text; ///< numbers and file paths, a line each; also when it passed
};

/// Holds a frame to another.
FrameCheck checkSameFrame(const Frame& expected, const Frame& actual, const Tolerance& tolerance = {});

/// Holds a frame to the golden NAME.png of goldenFolder(). When it is another one, the frame and a strip
/// expected | difference | actual are left in goldenOutFolder(), and the text names all three files. With
/// OFFSTAGE_UPDATE_GOLDENS=1 in the environment, a golden that is missing or does not hold is rewritten
/// instead: the check passes and the name goes to rewrittenGoldens(), by which the run must fail in the end.
/// A golden that cannot be read does not pass.
FrameCheck checkGolden(const Frame& actual, const std::string& name, const Tolerance& tolerance = {});

/// The files that checkGolden() has rewritten in this process, in order.
const std::vector<std::filesystem::path>& rewrittenGoldens();

/// Where goldens are: what setGoldenFolder() says, else the environment's OFFSTAGE_GOLDENS, else "goldens" in
/// the working directory.
std::filesystem::path goldenFolder();
void setGoldenFolder(const std::filesystem::path& folder);

/// Where checkGolden() leaves what was drawn: what setGoldenOutFolder() says, else the environment's
/// OFFSTAGE_GOLDEN_OUT, else "out/golden" in the working directory.
std::filesystem::path goldenOutFolder();
void setGoldenOutFolder(const std::filesystem::path& folder);

} // namespace offstage
