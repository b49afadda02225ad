#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

#include <filesystem>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

TEST(Package, AnotherProjectFindsBuildsAndRunsTheInstalledLibrary) {
  const TempDir dir;
  const std::string prefix = (dir / "prefix").string();
  const std::string build = (dir / "build").string();
  const std::string source = OFFSTAGE_SOURCE_DIR "/tests/package";
  const std::string flags = "-DCMAKE_CXX_FLAGS=" OFFSTAGE_CXX_FLAGS;
  const ProcessResult installed = runProcess({"cmake", "--install", OFFSTAGE_BINARY_DIR, "--prefix", prefix});
  ASSERT_EQ(installed.status, 0) << installed.err;
  const ProcessResult configured =
      runProcess({"cmake", "-G", "Ninja", "-S", source, "-B", build, "-DCMAKE_PREFIX_PATH=" + prefix, flags});
  ASSERT_EQ(configured.status, 0) << configured.err;
  const ProcessResult built = runProcess({"cmake", "--build", build});
  ASSERT_EQ(built.status, 0) << built.out << built.err;

  const std::string ofStudent = (dir / "student.txt").string();
  const std::string ofScene = (dir / "scene.txt").string();
  const ProcessResult ran = runProcess({build + "/student", "--hash", ofStudent});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const ProcessResult program =
      runProcess({prefix + "/bin/offstage", "render", scene("exercise1_bounce"), "--hash", ofScene});
  ASSERT_EQ(program.status, 0) << program.err;
  EXPECT_EQ(readFile(ofStudent), readFile(ofScene));

  // Its test records its golden, which does not count as passing, and then holds to it.
  std::filesystem::create_directory(dir / "goldens");
  ProcessOptions inDir;
  inDir.directory = dir.path();
  EXPECT_EQ(runProcess({build + "/student_test"}, inDir).status, 1);
  inDir.environment = {{"OFFSTAGE_UPDATE_GOLDENS", "1"}};
  EXPECT_EQ(runProcess({build + "/student_test"}, inDir).status, 1);
  inDir.environment.clear();
  const ProcessResult held = runProcess({build + "/student_test"}, inDir);
  EXPECT_EQ(held.status, 0) << held.out << held.err;
}

} // namespace
} // namespace offstage::test
