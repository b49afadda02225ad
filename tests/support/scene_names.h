#pragma once

#include <string>
#include <vector>

namespace offstage::test {

/// Whether this machine can draw a scene of scenes/: one with a formula needs TeX.
bool canBeDrawn(const std::string& name);

/// The names of the scenes in scenes/ that can be drawn here, sorted.
std::vector<std::string> sceneNames();

} // namespace offstage::test
