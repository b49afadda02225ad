#include "src/scene/film.h"
#include "tests/support/scene_text.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

using test::errorsOf;
using test::sceneOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Film filmOf(const std::string& text, const std::vector<double>& narrations = {}) {
  const Scene scene = sceneOf(text);
  return makeFilm(scene.timeline, scene.clock, narrations, scene.title);
}

TEST(Film, OfASceneThatSaysNothingHasTheClocksTime) {
  const Film film = filmOf("duration = 2.5\n");
  EXPECT_FALSE(film.map);
  EXPECT_EQ(film.seconds, 2.5);
  EXPECT_EQ(film.videoTime(1.25), 1.25);
  EXPECT_TRUE(film.chapters.empty());
}

TEST(Film, ChaptersCoverTheVideoFromItsBeginning) {
  const Film film = filmOf("title = \"T\"\nduration = 9\n[[section]]\ntitle = \"B\"\nstart = 5\n"
                           "[[section]]\ntitle = \"A\"\nstart = 2\n");
  ASSERT_EQ(film.chapters.size(), 3U);
  EXPECT_EQ(film.chapters[0].title, "T");
  EXPECT_EQ(film.chapters[0].end, 2.0);
  EXPECT_EQ(film.chapters[1].title, "A");
  EXPECT_EQ(film.chapters[1].end, 5.0);
  EXPECT_EQ(film.chapters[2].title, "B");
  EXPECT_EQ(film.chapters[2].end, 9.0);
}

TEST(Film, PausesAndSpeedsMakeTheVideoLongerAndShorter) {
  const Film film =
      filmOf("duration = 4\n[[pause]]\nat = 1\nfor = 0.5\n[[speed]]\nfrom = 2\nto = 3\nfactor = 0.25\n"
             "[[speed]]\nfrom = 3\nfactor = 2\n");
  EXPECT_DOUBLE_EQ(film.seconds, 1 + 0.5 + 1 + 4 + 0.5);
  EXPECT_DOUBLE_EQ(film.videoTime(1.0), 1.0);
  EXPECT_DOUBLE_EQ(film.videoTime(2.5), 2.5 + 2.0);
  EXPECT_EQ(film.moment(75), (Moment{60, 0.0}));
  EXPECT_EQ(film.moment(151), (Moment{120, 0.25}));
}

TEST(Film, ACardStandsWithinItsSection) {
  const Film film = filmOf("duration = 2\n[[section]]\ntitle = \"A\"\nstart = 0\ncard = 1.5\n");
  EXPECT_DOUBLE_EQ(film.seconds, 3.5);
  ASSERT_EQ(film.cards.size(), 1U);
  EXPECT_DOUBLE_EQ(film.cards[0].to, 1.5);
  EXPECT_EQ(film.moment(89), (Moment{0, 0.0}));
  EXPECT_EQ(film.moment(91), (Moment{1, 0.0}));
}

TEST(Film, NoSectionStartsWhileATitleCardStands) {
  const auto two = [](const std::string& first, const std::string& second) {
    return "duration = 4\n[[section]]\ntitle = \"A\"\n" + first + "\n[[section]]\ntitle = \"B\"\n" + second +
           "\n";
  };
  constexpr const char* kError =
      "scene.toml:6:1: error: 'start' in [[section]] is 1 s, but the title card of \"A\" stands until 2.5 s";
  EXPECT_THAT(errorsOf(two("start = 0.5\ncard = 2", "start = 1\ncard = 2")), ElementsAre(kError));
  EXPECT_THAT(errorsOf(two("start = 0.5\ncard = 2", "start = 1")), ElementsAre(kError));
  // In the order of time, not of the file.
  EXPECT_THAT(
      errorsOf(two("start = 0.2\ncard = 1", "start = 0.1\ncard = 0.2")),
      ElementsAre("scene.toml:2:1: error: 'start' in [[section]] is 0.2 s, but the title card of \"B\" "
                  "stands until 0.3 s"));
  EXPECT_THAT(errorsOf(two("start = 0.1\ncard = 0.2", "start = 0.3\ncard = 1")), ElementsAre());
  EXPECT_THAT(errorsOf(two("start = 0.1\ncard = 0.2", "start = 0.3")), ElementsAre());
}

TEST(Film, ATitleCardMayStandAtTheVideosEndButNotBehindIt) {
  const auto at = [](const std::string& start) {
    return "duration = 2\n[[section]]\ntitle = \"A\"\nstart = " + start + "\ncard = 1\n";
  };
  EXPECT_DOUBLE_EQ(filmOf(at("2")).seconds, 3.0);
  EXPECT_THAT(errorsOf(at("5")),
              ElementsAre("scene.toml:2:1: error: 'start' in [[section]] is 5 s, but the video ends at 2 s"));
}

TEST(Film, ANarrationCanMoveASectionOutOfATitleCard) {
  Timeline timeline;
  timeline.sections.resize(2);
  timeline.sections[0].title = "A";
  timeline.sections[0].card = 2.0;
  timeline.sections[0].narration = SoundFile{"x.wav", {}, ""};
  timeline.sections[1].title = "B";
  timeline.sections[1].start = 1.0;
  const Clock clock = Clock::fixed(60.0, 240);
  EXPECT_DOUBLE_EQ(makeFilm(timeline, clock, std::vector<double>{2.0}, "T").chapters[1].start, 2.0);
  EXPECT_THROW(makeFilm(timeline, clock, std::vector<double>{1.5}, "T"), SceneError);
}

TEST(Film, ASectionLastsAsLongAsItsNarrationAndMovesThoseAfterIt) {
  Timeline timeline;
  timeline.sections.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    timeline.sections[i].title = std::string(1, static_cast<char>('A' + i));
    timeline.sections[i].start = 2.0 * static_cast<double>(i);
    timeline.sections[i].narration = SoundFile{"x.wav", {}, ""};
  }
  Caption caption;
  caption.text = "c";
  caption.from = 0.5;
  caption.to = 1.0;
  caption.section = 2;
  timeline.captions.push_back(caption);
  const std::vector<double> lengths{3.0, 1.0, 2.5};
  const Film film = makeFilm(timeline, Clock::fixed(60.0, 360), lengths, "T");
  EXPECT_DOUBLE_EQ(film.seconds, 3.0 + 2.0 + 2.5);
  ASSERT_EQ(film.voices.size(), 3U);
  EXPECT_DOUBLE_EQ(film.voices[1].start, 3.0);
  EXPECT_DOUBLE_EQ(film.voices[2].start, 5.0);
  EXPECT_DOUBLE_EQ(film.captions[0].from, 5.5);
  EXPECT_EQ(film.moment(150), (Moment{120, 0.0})); // stands at the section's end
  EXPECT_EQ(film.moment(181), (Moment{121, 0.0}));
  EXPECT_EQ(film.moment(449), (Moment{360, 0.0})); // and at the video's
}

TEST(Film, OneNarrationForAllLetsTheEndStand) {
  Timeline timeline;
  timeline.narration = SoundFile{"x.wav", {}, ""};
  timeline.narrationStart = 1.0;
  const Film film = makeFilm(timeline, Clock::fixed(60.0, 120), std::vector<double>{2.5}, "T");
  EXPECT_DOUBLE_EQ(film.seconds, 3.5);
  EXPECT_EQ(film.moment(209), (Moment{120, 0.0}));
}

TEST(Film, SlowMotionOfARecordedClockMovesBetweenItsFrames) {
  Timeline timeline;
  timeline.speeds.push_back({0.0, 0.1, 0.5});
  const Clock clock = Clock::recorded({30'000'000, 70'000'000, 100'000'000});
  const Film film = makeFilm(timeline, clock, {}, "T");
  EXPECT_DOUBLE_EQ(film.seconds, 0.3);
  EXPECT_EQ(film.moment(0), (Moment{0, 0.0}));
  const Moment moment = film.moment(3); // at 1.5/60 s of the 0.03 s
  EXPECT_EQ(moment.frame, 0);
  EXPECT_NEAR(moment.fraction, 0.025 / 0.03, 1e-12);
  EXPECT_EQ(film.moment(16), (Moment{2, 0.0})); // at normal speed, the frame that has come
}

TEST(Film, ErrorsNameThePlaceTheKeyAndTheLimit) {
  EXPECT_THAT(errorsOf("duration = 2\n[[section]]\ntitle = \"A\"\nstart = 2\n"),
              ElementsAre("scene.toml:2:1: error: 'start' in [[section]] is 2 s, but the video ends at 2 s"));
  EXPECT_THAT(errorsOf("duration = 2\n[[caption]]\ntext = \"A\"\nfrom = 3\nto = 4\n"),
              ElementsAre("scene.toml:2:1: error: 'from' in [[caption]] is 3 s, but the video ends at 2 s"));
  EXPECT_THAT(errorsOf("[[caption]]\ntext = \"A\"\nfrom = 3\nto = 3\n"),
              ElementsAre("scene.toml:4:6: error: 'to' in [[caption]] is 3 s, not after 'from', 3 s"));
  EXPECT_THAT(
      errorsOf("duration = 2\n[[pause]]\nat = 2.5\nfor = 1\n"),
      ElementsAre(HasSubstr("scene.toml:3:6: error: 'at' in [[pause]] is 2.5 s of simulated time, but the "
                            "scene ends at 2 s")));
  EXPECT_THAT(
      errorsOf("[[speed]]\nfrom = 1\nto = 3\nfactor = 2\n[[speed]]\nfrom = 2\nto = 4\nfactor = 0.5\n"),
      ElementsAre(HasSubstr("5:1: error: [[speed]] from 2 s to 4 s overlaps that from 1 s to 3 s")));
  EXPECT_THAT(errorsOf("[[speed]]\nfrom = 1\nto = 3\nfactor = 0\n"),
              ElementsAre(HasSubstr("'factor' in [[speed]] must be from 0.001 to 1000, but it is")));
  EXPECT_THAT(errorsOf("[[caption]]\ntext = \"a\\u0007\"\nfrom = 0\nto = 1\n"),
              ElementsAre(HasSubstr("2:8: error: 'text' in [[caption]] holds the control character \\x07")));
  EXPECT_THAT(errorsOf("[[caption]]\ntext = \" \\n \"\nfrom = 0\nto = 1\n"),
              ElementsAre(HasSubstr("holds nothing to see")));
  EXPECT_THAT(errorsOf("[[caption]]\ntext = \"" + std::string(2001, 'x') + "\"\nfrom = 0\nto = 1\n"),
              ElementsAre(HasSubstr("holds 2001 bytes, but at most 2000 are allowed")));
  EXPECT_THAT(errorsOf("[[caption]]\ntext = \"a\"\non = \"bounse\"\n"),
              ElementsAre(HasSubstr("did you mean \"bounce\"?")));
  EXPECT_THAT(errorsOf("[[caption]]\ntext = \"a\"\non = \"bounce\"\nfrom = 1\n"),
              ElementsAre(HasSubstr("'from' in [[caption]] cannot stand beside 'on'")));
  EXPECT_THAT(
      errorsOf("[[section]]\ntitle = \"Euler\"\nstart = 0\n[[caption]]\ntext = \"a\"\nfrom = 0\nto = 1\n"
               "section = \"Eulr\"\n"),
      ElementsAre(HasSubstr("did you mean \"Euler\"?")));
  EXPECT_THAT(errorsOf("[[section]]\ntitle = \"A\"\nstart = 0\n[[section]]\ntitle = \"B\"\nstart = 0\n"),
              ElementsAre(HasSubstr("has the start of that in line 1")));
  EXPECT_THAT(errorsOf("[[camera]]\nat = 0\ncenter = \"ball\"\n"),
              ElementsAre(HasSubstr("unknown body, \"ball\"")));
  EXPECT_THAT(
      errorsOf("[narration]\nfile = \"gone.wav\"\n"),
      ElementsAre(HasSubstr("2:8: error: 'file' in [narration] names the file \"gone.wav\", which does not "
                            "exist beside the scene")));
}

TEST(Film, FadesLeaveAMomentAtWhichThePictureIsThere) {
  EXPECT_THAT(errorsOf("duration = 4\n[timeline]\nfade_in = 2\nfade_out = 2\n"), ElementsAre());
  EXPECT_THAT(
      errorsOf("duration = 4\n[timeline]\nfade_in = 2\nfade_out = 3\n"),
      ElementsAre("scene.toml:4:12: error: 'fade_out' in [timeline] is 3 s and 'fade_in' 2 s, but the "
                  "video lasts only 4 s: the picture would never be there in full"));
  EXPECT_THAT(
      errorsOf("duration = 4\n[timeline]\nfade_in = 5\n"),
      ElementsAre("scene.toml:3:11: error: 'fade_in' in [timeline] is 5 s, but the video lasts only 4 s: "
                  "the picture would never be there in full"));
  // It is the video that counts, here with a pause.
  EXPECT_THAT(errorsOf("duration = 4\n[timeline]\nfade_in = 5\n[[pause]]\nat = 1\nfor = 1\n"), ElementsAre());
  SceneOverrides overrides;
  overrides.duration = 1.0;
  EXPECT_THAT(errorsOf("duration = 4\n[timeline]\nfade_in = 2\nfade_out = 2\n", overrides), ElementsAre());
}

TEST(Film, AShorterDurationLeavesOutWhatLiesBehindIt) {
  SceneOverrides overrides;
  overrides.duration = 1.0;
  const Scene scene =
      sceneOf("duration = 9\n[[section]]\ntitle = \"A\"\nstart = 0\n[[section]]\ntitle = \"B\"\nstart = 5\n"
              "[[caption]]\ntext = \"c\"\nfrom = 6\nto = 7\n[[caption]]\ntext = \"d\"\nfrom = 0\nto = 1\n"
              "section = \"B\"\n[[pause]]\nat = 8\nfor = 1\n",
              overrides);
  const Film film = makeFilm(scene.timeline, scene.clock, {}, scene.title);
  EXPECT_EQ(film.seconds, 1.0);
  EXPECT_EQ(film.chapters.size(), 1U);
  EXPECT_TRUE(film.captions.empty());
}

} // namespace
} // namespace offstage
