#include "render/job/progress.h"
#include "render/job/progress_line.h"

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

TEST(ProgressLine, FillsItsBarByWhatIsDoneAndFitsTheTerminal) {
  ProgressState state;
  state.done = 150;
  state.frames = 300;
  state.fps = 75.2;
  state.speed = 1.25;
  state.eta = 2.0;
  state.bytes = 20480;
  const std::string numbers = "150/300 frames  75 fps  1.2x  ETA 0:02  20 KiB";
  EXPECT_EQ(progressLine(state, 80), "[##############..............] " + numbers);
  EXPECT_EQ(progressLine(state, 200), progressLine(state, 80));
  EXPECT_EQ(progressLine(state, 60), "[#####.....] " + numbers);
  EXPECT_EQ(progressLine(state, 50), numbers);
  EXPECT_EQ(progressLine(state, 20), "150/300 frames  75 ");
  EXPECT_EQ(progressLine(state, 0), "");
  for (int columns = 1; columns < 120; ++columns)
    EXPECT_LT(progressLine(state, columns).size(), static_cast<std::size_t>(columns));
}

TEST(ProgressLine, PromisesNoEndBeforeItKnowsASpeed) {
  ProgressState state;
  state.frames = 300;
  EXPECT_NE(progressLine(state, 80).find("ETA -:--"), std::string::npos) << progressLine(state, 80);
  EXPECT_NE(progressJson(state).find("\"eta\":null,"), std::string::npos) << progressJson(state);
  state.eta = 3725.0;
  EXPECT_NE(progressLine(state, 80).find("ETA 1:02:05"), std::string::npos) << progressLine(state, 80);
  EXPECT_NE(progressJson(state).find("\"eta\":3725.0,"), std::string::npos) << progressJson(state);
}

} // namespace
} // namespace offstage
