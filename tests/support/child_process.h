#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace offstage::test {

struct ChildResult {
  int exitStatus = -1; ///< 128 + signal when it was killed
  std::string output;  ///< stdout and stderr
};

/// Variables to set, or to unset where there is no value.
using ChildEnvironment = std::vector<std::pair<std::string, std::optional<std::string>>>;

/// Runs one test of this test program in a process of its own, with changes to the environment: Mesa reads
/// its settings once a process.
ChildResult runTestInChild(const std::string& filter, const ChildEnvironment& environment);

} // namespace offstage::test
