#include "src/scene/scene.h"
#include "tests/support/process.h"
#include "tests/support/scene_names.h"
#include "tests/support/temp_dir.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

using Environment = std::vector<std::pair<std::string, std::optional<std::string>>>;

/// What Mesa may be on another machine: the processor's instructions, llvmpipe's vector width and threads,
/// the backend. Every processor at every width, and every width with every number of threads; with `whole`
/// all of them with each other.
std::vector<Environment> machines(bool whole) {
  std::vector<Environment> all;
  const std::vector<std::optional<std::string>> processors{"sse2", "sse4.1", "avx", "avx2", std::nullopt};
  for (const auto& processor : processors)
    for (const char* width : {"128", "256", "512"})
      for (const char* threads : {"0", "1", "4"}) {
        if (!whole && processor && threads != std::string_view("0")) continue;
        all.push_back({{"OFFSTAGE_GL", "osmesa"},
                       {"MESA_SHADER_CACHE_DISABLE", "true"}, // it does not tell vector widths apart
                       {"GALLIUM_OVERRIDE_CPU_CAPS", processor},
                       {"LP_NATIVE_VECTOR_WIDTH", width},
                       {"LP_NUM_THREADS", threads}});
      }
  all.push_back({{"OFFSTAGE_GL", "egl"}});
  return all;
}

std::string describe(const Environment& environment) {
  std::string text;
  for (const auto& [name, value] : environment) text += name + "=" + value.value_or("(unset)") + " ";
  return text;
}

/// State and pixel hashes of a few frames in the middle of a scene.
std::string hashes(const std::string& file, double from, const Environment& environment) {
  const TempDir dir;
  ProcessOptions options;
  options.environment = environment;
  const ProcessResult result = offstage({"render", file, "--from", std::to_string(from), "--to",
                                         std::to_string(from + 0.05), "--hash", dir / "h.txt"},
                                        options);
  EXPECT_EQ(result.status, 0) << describe(environment) << result.err;
  return readFile(dir / "h.txt");
}

class OneResult : public ::testing::TestWithParam<std::string> {};

TEST_P(OneResult, OfASceneOnEveryProcessorVectorWidthThreadCountAndBackend) {
  const std::string file = scene(GetParam());
  const double from = std::min(3.0, 0.5 * loadScene(file).clock.duration());
  const std::string expected = hashes(file, from, {});
  ASSERT_NE(expected, "");
  for (const Environment& environment : machines(GetParam() == "shapes"))
    EXPECT_EQ(hashes(file, from, environment), expected) << GetParam() << " with " << describe(environment);
}

/// Every scene of one idea. The lectures only put together what these hold, at twice the size.
std::vector<std::string> singleIdeas() {
  std::vector<std::string> names = sceneNames();
  std::erase_if(names, [](const std::string& name) { return name.starts_with("lecture_"); });
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, OneResult, ::testing::ValuesIn(singleIdeas()),
                         [](const auto& name) { return name.param; });

} // namespace
} // namespace offstage::test
