#include "tests/support/process.h"

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// A compiler and an optimisation level to build the simulation with once more.
struct Variant {
  std::string name;
  std::string compiler;
  std::string flags;
};

void PrintTo(const Variant& variant, std::ostream* out) {
  *out << variant.compiler << ' ' << variant.flags;
}

class Parity : public ::testing::TestWithParam<Variant> {};

std::vector<std::filesystem::path> filesOf(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST_P(Parity, TracesAreTheProgramsByteForByte) {
  const Variant& variant = GetParam();
  const std::string folder = std::string(OFFSTAGE_BINARY_DIR "/parity/") + variant.name;
  const std::string source = OFFSTAGE_SOURCE_DIR "/tests/parity";
  const ProcessResult configured =
      runProcess({"cmake", "-G", "Ninja", "-S", source, "-B", folder, "-DCMAKE_BUILD_TYPE=None",
                  "-DCMAKE_CXX_COMPILER=" + variant.compiler, "-DCMAKE_CXX_FLAGS=" + variant.flags});
  ASSERT_EQ(configured.status, 0) << configured.err;
  const ProcessResult built = runProcess({"cmake", "--build", folder});
  ASSERT_EQ(built.status, 0) << built.out << built.err;

  const std::string reference = OFFSTAGE_SOURCE_DIR "/tests/reference/";
  int compared = 0;
  for (const std::filesystem::path& sceneFile : filesOf(reference + "oracle_scenes")) {
    for (const std::filesystem::path& log : filesOf(reference + "trajectories/dt")) {
      const ProcessResult expected = offstage({"trace", sceneFile.string(), "--dt", log.string()});
      ASSERT_EQ(expected.status, 0) << expected.err;
      const ProcessResult actual = runProcess({folder + "/trace", sceneFile.string(), log.string()});
      ASSERT_EQ(actual.status, 0) << actual.err;
      const auto [a, b] =
          std::mismatch(actual.out.begin(), actual.out.end(), expected.out.begin(), expected.out.end());
      EXPECT_TRUE(a == actual.out.end() && b == expected.out.end())
          << sceneFile.filename() << " with " << log.filename() << " differs from line "
          << std::count(actual.out.begin(), a, '\n') + 1 << " on";
      ++compared;
    }
  }
  EXPECT_GE(compared, 24);

  // The hash that PileSolver.WorkloadSHasThePinnedStateHash holds this build to.
  const ProcessResult pile = runProcess({folder + "/pile", "400", "300"});
  EXPECT_EQ(pile.out, "f56b29432c21d9bf\n") << pile.err;
}

INSTANTIATE_TEST_SUITE_P(Compilers, Parity,
                         ::testing::Values(Variant{"gcc_O0", "g++", "-O0"},
                                           Variant{"gcc_O3_native", "g++", "-O3 -march=native"},
                                           Variant{"clang_O0", "clang++", "-O0"},
                                           Variant{"clang_O3_native", "clang++", "-O3 -march=native"}),
                         [](const auto& variant) { return variant.param.name; });

} // namespace
} // namespace offstage::test
