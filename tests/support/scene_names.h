#pragma once

#include <string>
#include <vector>

namespace offstage::test {

/// The names of the scenes in scenes/, sorted.
std::vector<std::string> sceneNames();

} // namespace offstage::test
