#include "tests/support/child_process.h"

#include <array>
#include <cstdlib>
#include <sys/wait.h>
#include <unistd.h>

namespace offstage::test {

ChildResult runTestInChild(const std::string& filter, const ChildEnvironment& environment) {
  ChildResult result;
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return result;
  const std::string filterOption = "--gtest_filter=" + filter;
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    close(ends[0]);
    close(ends[1]);
    for (const auto& [name, value] : environment) {
      if (value) {
        setenv(name.c_str(), value->c_str(), 1);
      } else {
        unsetenv(name.c_str());
      }
    }
    execl("/proc/self/exe", "offstage_tests", filterOption.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    return result;
  }
  std::array<char, 4096> buffer{};
  for (ssize_t got = 0; (got = read(ends[0], buffer.data(), buffer.size())) > 0;) {
    result.output.append(buffer.data(), static_cast<std::size_t>(got));
  }
  close(ends[0]);
  int status = 0;
  if (waitpid(child, &status, 0) == child && WIFEXITED(status)) result.exitStatus = WEXITSTATUS(status);
  return result;
}

} // namespace offstage::test
