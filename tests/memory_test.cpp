#include "tests/support/process.h"
#include "tests/support/running.h"
#include "tests/support/temp_dir.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kOwnMemory = false; // AddressSanitizer takes several times as much
#else
constexpr bool kOwnMemory = true;
#endif

/// MB of a process and of all that it has started, what several share counted once (PSS; man 5 proc).
double memoryOf(int process) {
  double megabytes = 0.0;
  std::ifstream file("/proc/" + std::to_string(process) + "/smaps_rollup");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("Pss:")) megabytes += std::stod(line.substr(4)) * 1024e-6;
  for (const int child : childrenOf(process)) megabytes += memoryOf(child);
  return megabytes;
}

struct MemoryCase {
  std::string out;
  std::string background = "white";
  std::string quality;
};

class Memory : public ::testing::TestWithParam<MemoryCase> {};

TEST_P(Memory, StaysBelow150MbAnd120AWorkerAt1080p) {
  if (!kOwnMemory) GTEST_SKIP() << "AddressSanitizer takes memory of its own";
  const TempDir dir;
  std::string scene = "duration = 0.8\n[frame]\nsize = [1920, 1080]\nbackground = \"" +
                      GetParam().background + "\"\n[clock]\nfps = 60\n[walls]\nall = 1.0\n";
  for (int i = 0; i < 12; ++i) {
    scene += "[[body]]\nshape = \"circle\"\ncenter = [" + std::to_string(100 + 150 * i) + ", " +
             std::to_string(100 + 80 * i) + "]\nradius = 40\nvelocity = [300, 200]\n";
  }
  std::vector<std::string> command{program(), "render", dir.write("x.toml", scene), "--jobs",
                                   "2",       "-o",     dir / GetParam().out};
  if (!GetParam().quality.empty()) command.insert(command.end(), {"--quality", GetParam().quality});
  Running run(command);
  double most = 0.0;
  while (!run.wait(10)) most = std::max(most, memoryOf(run.id()));
  EXPECT_EQ(run.finish(), 0) << run.errors();
  EXPECT_GT(most, 50.0) << "the measurement has seen nothing";
  EXPECT_LT(most, 150.0 + 2 * 120.0);
}

INSTANTIATE_TEST_SUITE_P(
    All, Memory,
    ::testing::Values(MemoryCase{"good.mp4", "white", ""}, MemoryCase{"high.mp4", "white", "high"},
                      MemoryCase{"good.webm", "white", ""}, MemoryCase{"draft.webm", "white", "draft"},
                      MemoryCase{"alpha.webm", "transparent", ""},
                      MemoryCase{"draft_alpha.webm", "transparent", "draft"},
                      MemoryCase{"alpha.mov", "transparent", ""},
                      MemoryCase{"lossless.mkv", "white", "lossless"},
                      MemoryCase{"alpha.mkv", "transparent", "lossless"}, MemoryCase{"a.gif", "white", ""},
                      MemoryCase{"a.apng", "white", ""}, MemoryCase{"f%03d.png", "white", ""}),
    [](const ::testing::TestParamInfo<MemoryCase>& tested) {
      std::string name = tested.param.out;
      std::ranges::replace_if(
          name, [](char c) { return std::isalnum(c) == 0; }, '_');
      return name;
    });

} // namespace
} // namespace offstage::test
