#include "render/job/progress.h"

#include <algorithm>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

namespace offstage {
namespace {

/// What `show` prints to a stream that is no terminal.
template <class Show>
std::string printed(ProgressMode mode, Show show) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* stream = open_memstream(&text, &size);
  {
    Progress progress(mode, 4, 2.0, 0, stream);
    show(progress);
  }
  std::fclose(stream);
  std::string result(text, size);
  std::free(text);
  return result;
}

TEST(Progress, JsonIsALineEachAndEndsWithDone) {
  const std::string text = printed(ProgressMode::Json, [](Progress& progress) {
    progress.update(1, 100);
    progress.finish(400);
  });
  EXPECT_NE(text.find("{\"event\":\"progress\",\"frame\":1,\"frames\":4,"), std::string::npos) << text;
  EXPECT_NE(text.find("{\"event\":\"done\",\"frame\":4,\"frames\":4,"), std::string::npos) << text;
  EXPECT_NE(text.find("\"bytes\":400}\n"), std::string::npos) << text;
}

TEST(Progress, UpdatesAtMostTenTimesASecond) {
  const std::string text = printed(ProgressMode::Json, [](Progress& progress) {
    for (int i = 0; i < 1000; ++i) progress.update(2, i);
  });
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 3) << text;
}

TEST(Progress, SaysNothingWhenPipedOrSwitchedOff) {
  const auto all = [](Progress& progress) {
    progress.update(2, 1);
    progress.finish(2);
  };
  EXPECT_EQ(printed(ProgressMode::Auto, all), "");
  EXPECT_EQ(printed(ProgressMode::None, all), "");
}

} // namespace
} // namespace offstage
