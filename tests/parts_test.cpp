#include "render/job/parts.h"
#include "tests/support/child.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"

#include <array>
#include <filesystem>
#include <string>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

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
    EXPECT_THAT(parts.notice(), AllOf(StartsWith("starting over: "),
                                      HasSubstr("another render, which differs in the scene")));
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

  std::filesystem::create_directory(dir / "m.mp4.parts");
  test::writeFile(dir / "m.mp4.parts" / "manifest", "my manifest");
  test::writeFile(dir / "m.mp4.parts" / "000000.chunk", "my data");
  EXPECT_THAT(errorOf([&] { const Parts parts(dir / "m.mp4", manifestOf("a"), Parts::Use::Whole, true); }),
              AllOf(StartsWith("2: "), HasSubstr("'manifest'"), HasSubstr("move it away")));
  EXPECT_THAT(dir.names("m.mp4.parts"), ElementsAre("000000.chunk", "manifest"));

  // Of a part's name, but nothing that a part can be; opening the pipe would wait for ever.
  std::filesystem::create_directories(dir / "c.mp4.parts" / "000000.chunk");
  std::filesystem::create_directory(dir / "d.mp4.parts");
  ASSERT_EQ(mkfifo((dir / "d.mp4.parts" / "manifest").c_str(), 0600), 0);
  std::filesystem::create_directory(dir / "e.mp4.parts");
  std::filesystem::create_symlink(dir / "a.mp4.parts", dir / "e.mp4.parts" / "lock");
  const std::vector<std::pair<std::string, std::string>> cases{
      {"c.mp4", "000000.chunk"}, {"d.mp4", "manifest"}, {"e.mp4", "lock"}};
  for (const auto& entry : cases) {
    EXPECT_THAT(
        errorOf([&] { const Parts parts(dir / entry.first, manifestOf("a"), Parts::Use::Whole, true); }),
        AllOf(StartsWith("2: "), HasSubstr(entry.second), HasSubstr("move it away")));
  }
}

TEST(Parts, TheManifestGoesBehindTheChunksAndTheLockLast) {
  const TempDir dir;
  Parts parts(dir / "x.mp4", manifestOf("a"), Parts::Use::Whole, true);
  for (int chunk = 0; chunk < 20; ++chunk) test::writeFile(parts.chunk(chunk), "chunk");
  const int watch = inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
  ASSERT_GE(watch, 0);
  ASSERT_GE(inotify_add_watch(watch, parts.folder().c_str(), IN_DELETE), 0);
  parts.removeAll();
  std::vector<std::string> removed;
  alignas(inotify_event) std::array<char, 65536> buffer{};
  const ssize_t size = read(watch, buffer.data(), buffer.size());
  close(watch);
  for (ssize_t at = 0; at < size;) {
    const auto* event = reinterpret_cast<const inotify_event*>(buffer.data() + at);
    if (event->len > 0) removed.emplace_back(event->name);
    at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
  }
  ASSERT_EQ(removed.size(), 22U); // and the manifest
  EXPECT_EQ(removed[20], "manifest") << "chunks without one would be those of another render";
  EXPECT_EQ(removed.back(), "lock") << "another run could begin while this one still removes";
  EXPECT_THAT(dir.names(), IsEmpty());
}

TEST(Parts, AnyNameThatAFileCanHaveIsGoodEnough) {
  const TempDir dir;
  for (const std::string& stem : {std::string(249, 'a'), std::string(250, 'a'), std::string(251, 'a')}) {
    const std::string name = stem + ".mp4";
    EXPECT_EQ(errorOf([&] { const Parts parts(dir / name, manifestOf("a"), Parts::Use::Whole, true); }),
              "no error")
        << name.size() << " characters";
  }
  const std::string longName = std::string(120, 'b') + "\xC3\xA9" + std::string(128, 'b') + ".mp4";
  EXPECT_EQ(Parts::folderFor("out/" + longName).parent_path(), "out");
  EXPECT_EQ(Parts::folderFor(longName), Parts::folderFor(longName));
  EXPECT_NE(Parts::folderFor(longName), Parts::folderFor(longName.substr(0, 250) + "kv"));
  EXPECT_EQ(Parts::folderFor("out/x.mp4"), "out/x.mp4.parts");
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
