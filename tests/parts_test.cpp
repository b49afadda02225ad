#include "render/job/parts.h"
#include "tests/support/child.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

using test::errorOf;
using test::TempDir;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

Manifest manifestOf(const std::string& scene) {
  Manifest manifest;
  manifest.add("scene", scene);
  manifest.add("options", "--fps=30");
  manifest.add("options", "--size=64x48");
  return manifest;
}

TEST(Manifest, ReadsBackWhatItWrote) {
  const Manifest manifest = manifestOf("abc = d");
  EXPECT_EQ(Manifest::parse(manifest.text()), manifest);
  EXPECT_THAT(manifest.values("options"), ElementsAre("--fps=30", "--size=64x48"));
  EXPECT_THAT(manifest.values("nothing"), IsEmpty());
  EXPECT_EQ(Manifest::parse(""), std::nullopt);
  EXPECT_EQ(Manifest::parse("offstage parts 2\n"), std::nullopt);
  EXPECT_EQ(Manifest::parse("offstage parts 1\nno equals sign\n"), std::nullopt);
}

TEST(Manifest, NamesWhatDiffers) {
  Manifest other = manifestOf("b");
  EXPECT_EQ(manifestOf("b").differences(other), "");
  other.add("quality", "high");
  EXPECT_EQ(manifestOf("a").differences(other), "the scene, the quality");
}

TEST(Parts, GoWhenTheyHoldNoChunk) {
  const TempDir dir;
  {
    const Parts parts(dir / "x.mp4", manifestOf("a"), Parts::Use::Whole, true);
    EXPECT_THAT(dir.names(), ElementsAre("x.mp4.parts"));
  }
  EXPECT_THAT(dir.names(), IsEmpty());
}

TEST(Parts, StayWithTheirChunksForTheSameRenderOnly) {
  const TempDir dir;
  {
    const Parts parts(dir / "x.mp4", manifestOf("a"), Parts::Use::Whole, true);
    test::writeFile(parts.chunk(3), "chunk");
    test::writeFile(parts.folder() / ".000004.chunk.77.partial", "half a chunk");
  }
  {
    const Parts parts(dir / "x.mp4", manifestOf("a"), Parts::Use::Whole, true);
    EXPECT_EQ(parts.notice(), "");
    EXPECT_THAT(dir.names("x.mp4.parts"), ElementsAre("000003.chunk", "lock", "manifest"));
  }
  {
    const Parts parts(dir / "x.mp4", manifestOf("b"), Parts::Use::Whole, true);
    EXPECT_THAT(parts.notice(), AllOf(StartsWith("starting over: "), HasSubstr("(the scene differ)")));
    EXPECT_THAT(dir.names("x.mp4.parts"), ElementsAre("lock", "manifest"));
  }
}

TEST(Parts, NoResumeStartsOverInSilence) {
  const TempDir dir;
  { test::writeFile(Parts(dir / "x.mp4", manifestOf("a"), Parts::Use::Whole, true).chunk(0), "chunk"); }
  const Parts parts(dir / "x.mp4", manifestOf("a"), Parts::Use::Whole, false);
  EXPECT_EQ(parts.notice(), "");
  EXPECT_THAT(dir.names("x.mp4.parts"), ElementsAre("lock", "manifest"));
}

TEST(Parts, TouchNothingThatIsNotTheirs) {
  const TempDir dir;
  test::writeFile(dir / "a.mp4.parts", "a file");
  EXPECT_THAT(errorOf([&] { const Parts parts(dir / "a.mp4", manifestOf("a"), Parts::Use::Whole, true); }),
              AllOf(StartsWith("2: "), HasSubstr("move it away")));
  EXPECT_EQ(test::readFile(dir / "a.mp4.parts"), "a file");

  std::filesystem::create_directory(dir / "b.mp4.parts");
  test::writeFile(dir / "b.mp4.parts" / "thesis.tex", "precious");
  EXPECT_THAT(errorOf([&] { const Parts parts(dir / "b.mp4", manifestOf("a"), Parts::Use::Whole, false); }),
              AllOf(StartsWith("2: "), HasSubstr("thesis.tex")));
  EXPECT_THAT(dir.names("b.mp4.parts"), ElementsAre("thesis.tex"));
}

TEST(Parts, TwoRunsOnOneOutputDoNotMeet) {
  const TempDir dir;
  const Parts parts(dir / "x.mp4", manifestOf("a"), Parts::Use::Whole, true);
  test::writeFile(parts.chunk(0), "chunk");
  for (const Parts::Use use : {Parts::Use::Whole, Parts::Use::Segment}) {
    EXPECT_THAT(errorOf([&] { const Parts second(dir / "x.mp4", manifestOf("a"), use, true); }),
                AllOf(StartsWith("75: "), HasSubstr("another run")));
  }
  EXPECT_TRUE(std::filesystem::exists(parts.chunk(0)));
}

TEST(Parts, SegmentsOfOneRenderShareTheFolderOthersDoNot) {
  const TempDir dir;
  const Parts first(dir / "x.mp4", manifestOf("a"), Parts::Use::Segment, true);
  test::writeFile(first.chunk(0), "chunk");
  EXPECT_EQ(errorOf([&] { const Parts second(dir / "x.mp4", manifestOf("a"), Parts::Use::Segment, true); }),
            "no error");
  EXPECT_THAT(errorOf([&] { const Parts other(dir / "x.mp4", manifestOf("b"), Parts::Use::Segment, true); }),
              StartsWith("75: "));
  EXPECT_THAT(errorOf([&] { const Parts whole(dir / "x.mp4", manifestOf("a"), Parts::Use::Whole, true); }),
              StartsWith("75: "));
  EXPECT_TRUE(std::filesystem::exists(first.chunk(0)));
}

TEST(Parts, AFolderThatMayNotBeWrittenIsTheUsersMistake) {
  const TempDir dir;
  std::filesystem::create_directory(dir / "locked");
  std::filesystem::permissions(dir / "locked",
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_EQ(test::inChild([&] {
              test::becomeNobody();
              const std::string error = errorOf(
                  [&] { const Parts parts(dir / "locked/x.mp4", manifestOf("a"), Parts::Use::Whole, true); });
              return error.starts_with("2: cannot write ") ? 0 : 1;
            }),
            0);
}

} // namespace
} // namespace offstage
