#include "render/output/captions.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

using ::testing::ElementsAre;

constexpr std::int64_t kMs = 1000000;

TEST(WebVtt, HasTimesInMillisecondsAndEscapedTexts) {
  const std::vector<Cue> cues{{0, 1500 * kMs, "a < b & c --> d"},
                              {3723004 * kMs, 3724000 * kMs, "two\nlines"}};
  EXPECT_EQ(webVtt(cues), "WEBVTT\n\nNOTE made by Offstage\n"
                          "\n00:00:00.000 --> 00:00:01.500\na &lt; b &amp; c --&gt; d\n"
                          "\n01:02:03.004 --> 01:02:04.000\ntwo\nlines\n");
  EXPECT_TRUE(isOwnWebVtt(webVtt(cues)));
  EXPECT_TRUE(isOwnWebVtt(webVtt(std::vector<Cue>{})));
  EXPECT_FALSE(isOwnWebVtt("WEBVTT\n\n00:00.000 --> 00:01.000\nmine\n"));
}

TEST(WebVtt, LeavesOutWhatNoMillisecondIsLeftOf) {
  EXPECT_EQ(webVtt(std::vector<Cue>{{100, 400000, "short"}}), "WEBVTT\n\nNOTE made by Offstage\n");
}

TEST(WebVtt, KeepsEmptyLinesFromEndingACue) {
  EXPECT_EQ(webVttText("a\n\nb"), "a\n\xc2\xa0\nb");
  EXPECT_EQ(webVttText("a\n"), "a\n\xc2\xa0");
  EXPECT_EQ(webVttText("\na"), "\xc2\xa0\na");
}

TEST(WithoutOverlaps, CoversEveryMomentOnce) {
  const std::vector<Cue> cues{{2, 6, "a"}, {4, 9, "b"}, {12, 40, "c"}};
  EXPECT_THAT(withoutOverlaps(cues, 20), ElementsAre(Cue{0, 2, ""}, Cue{2, 4, "a"}, Cue{4, 6, "a\nb"},
                                                     Cue{6, 9, "b"}, Cue{9, 12, ""}, Cue{12, 20, "c"}));
  EXPECT_THAT(withoutOverlaps(std::vector<Cue>{}, 20), ElementsAre(Cue{0, 20, ""}));
}

TEST(WithoutOverlaps, CutsATextThatIsTooLongBehindAWholeCharacter) {
  std::string wide;
  for (int i = 0; i < 40000; ++i) wide += "ä"; // two bytes each
  const std::vector<Cue> row = withoutOverlaps(std::vector<Cue>{{0, 5, wide}}, 5);
  EXPECT_EQ(row.at(0).text, wide.substr(0, 65534));
}

TEST(WithoutOverlaps, JoinsNeighboursOfOneText) {
  const std::vector<Cue> cues{{0, 5, "a"}, {5, 9, "a"}};
  EXPECT_THAT(withoutOverlaps(cues, 9), ElementsAre(Cue{0, 9, "a"}));
}

} // namespace
} // namespace offstage
