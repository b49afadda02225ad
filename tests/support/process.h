#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace offstage::test {

/// What a program left behind.
struct ProcessResult {
  int status = -1; ///< exit status; 128 + signal when it was killed
  std::string out;
  std::string err;
};

/// How to run it.
struct ProcessOptions {
  /// Set in addition to the test's own; nothing: unset.
  std::vector<std::pair<std::string, std::optional<std::string>>> environment;
  std::filesystem::path directory; ///< working directory; empty: the test's
  int interruptAfterMs = 0;        ///< > 0: send SIGINT after this time
  bool closedOutput = false;       ///< standard output is a pipe that nobody reads
  bool closedErrors = false;       ///< and so is standard error
};

/// Runs a program to its end and collects what it prints. `arguments` starts with the program's path.
ProcessResult runProcess(const std::vector<std::string>& arguments, const ProcessOptions& options = {});

/// The program that was built, to be run by other means than offstage().
std::string program();

/// Runs the offstage program that this build made.
ProcessResult offstage(std::vector<std::string> arguments, const ProcessOptions& options = {});

/// A scene of the source tree, such as scene("fall").
std::string scene(const std::string& name);

} // namespace offstage::test
