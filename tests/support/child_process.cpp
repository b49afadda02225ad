#include "tests/support/child_process.h"

#include "tests/support/process.h"

namespace offstage::test {

ChildResult runTestInChild(const std::string& filter, const ChildEnvironment& environment) {
  ProcessOptions options;
  options.environment = environment;
  const ProcessResult result = runProcess({"/proc/self/exe", "--gtest_filter=" + filter}, options);
  return {result.status, result.out + result.err};
}

} // namespace offstage::test
