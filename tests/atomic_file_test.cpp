#include "render/output/atomic_file.h"
#include "render/output/file_error.h"
#include "tests/support/child.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"

#include <cerrno>
#include <csignal>
#include <memory>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

#include <climits>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

namespace fs = std::filesystem;
using test::errorOf;
using test::inChild;
using test::readFile;
using test::TempDir;
using test::writeFile;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

std::string openError(const fs::path& path) {
  return errorOf([&path] { const AtomicFile file(path); });
}

mode_t modeOf(const fs::path& path) {
  struct stat info {};
  EXPECT_EQ(stat(path.c_str(), &info), 0) << path;
  return info.st_mode & 07777U;
}

TEST(AtomicFile, AppearsUnderItsNameOnlyWithCommit) {
  const TempDir dir;
  AtomicFile file(dir / "a.bin");
  file.write("hello, ");
  file.write("world");
  EXPECT_THAT(dir.names(), ElementsAre(fmt::format(".a.bin.{}.partial", getpid())));
  EXPECT_EQ(file.temporary().parent_path(), dir.path());
  file.commit();
  EXPECT_THAT(dir.names(), ElementsAre("a.bin"));
  EXPECT_EQ(readFile(dir / "a.bin"), "hello, world");
}

TEST(AtomicFile, OlderFileStaysUntilCommit) {
  const TempDir dir;
  writeFile(dir / "a", "old");
  {
    AtomicFile file(dir / "a");
    file.write("new");
    EXPECT_EQ(readFile(dir / "a"), "old");
  }
  EXPECT_EQ(readFile(dir / "a"), "old") << "destroyed without commit";
  EXPECT_THAT(dir.names(), ElementsAre("a"));
  AtomicFile file(dir / "a");
  file.write("new");
  file.commit();
  EXPECT_EQ(readFile(dir / "a"), "new");
}

TEST(AtomicFile, SeeksAndOverwrites) {
  const TempDir dir;
  AtomicFile file(dir / "a");
  file.write("0123456789");
  EXPECT_EQ(file.seek(2, SEEK_SET), 2);
  file.write("ab");
  EXPECT_EQ(file.seek(0, SEEK_CUR), 4);
  EXPECT_EQ(file.seek(0, SEEK_END), 10);
  file.commit();
  EXPECT_EQ(readFile(dir / "a"), "01ab456789");
}

TEST(AtomicFile, RefusesWhatCannotBeWrittenWithTheReason) {
  const TempDir dir;
  writeFile(dir / "file", "");
  fs::create_symlink("loop", dir / "loop");
  ASSERT_EQ(mkfifo((dir / "fifo").c_str(), 0600), 0);
  const auto text = [&dir](const std::string& name) {
    return fmt::format("2: cannot write '{}': ", (dir / name).native());
  };
  EXPECT_EQ(openError(""), "2: cannot write a file without a name");
  EXPECT_EQ(openError(dir.path()), "2: cannot write '" + dir.path().native() + "': it is a folder");
  EXPECT_EQ(openError(dir / "x/"), text("x/") + "a name that ends in / names a folder");
  fs::create_directory(dir / "d");
  EXPECT_EQ(openError(dir / "d/"), text("d/") + "it is a folder");
  EXPECT_EQ(openError(dir / "none/a"),
            text("none/a") + "the folder '" + (dir / "none").native() + "' does not exist");
  EXPECT_EQ(openError(dir / "file/a"),
            text("file/a") + "a part of '" + (dir / "file").native() + "' is not a folder");
  fs::create_symlink("none/a", dir / "link");
  EXPECT_EQ(openError(dir / "link"),
            text("none/a") + "the folder '" + (dir / "none").native() + "' does not exist");
  EXPECT_EQ(openError(dir / "loop"), text("loop") + "its symbolic links lead in a circle");
  EXPECT_THAT(openError(dir / "fifo"), StartsWith(text("fifo") + "it is a device, a pipe or a socket"));
  EXPECT_THAT(openError("/dev/null"), StartsWith("2: cannot write '/dev/null': it is a device"));
  EXPECT_EQ(openError(dir / std::string(256, 'n')), text(std::string(256, 'n')) + "the name is too long");
  EXPECT_THAT(dir.names(), ElementsAre("d", "fifo", "file", "link", "loop")) << "nothing left behind";
}

TEST(AtomicFile, RefusesFoldersAndFilesWithoutPermission) {
  const TempDir dir;
  fs::create_directory(dir / "closed");
  fs::create_directory(dir / "open");
  writeFile(dir / "open/protected", "x");
  chmod((dir / "closed").c_str(), 0555);
  chmod((dir / "open/protected").c_str(), 0444);
  chmod((dir / "open").c_str(), 0777);
  chmod(dir.path().c_str(), 0755);
  EXPECT_EQ(inChild([&dir] {
              test::becomeNobody();
              const std::string folder = openError(dir / "closed/a");
              const std::string file = openError(dir / "open/protected");
              if (folder != "2: cannot write '" + (dir / "closed/a").native() +
                                "': no permission to write in the folder '" + (dir / "closed").native() +
                                "'") {
                return 1;
              }
              return file == "2: cannot write '" + (dir / "open/protected").native() +
                                 "': the file is write-protected"
                         ? 0
                         : 2;
            }),
            0);
}

TEST(AtomicFile, InAStickyFolderOnlyTheOwnerReplacesAFile) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can make a file of another owner";
  const TempDir dir;
  chmod(dir.path().c_str(), 01777);
  writeFile(dir / "shared", "precious");
  chmod((dir / "shared").c_str(), 0666);
  EXPECT_EQ(openError(dir / "shared"), "no error") << "root may";
  EXPECT_EQ(inChild([&dir] {
              test::becomeNobody();
              const std::string expected = "2: cannot write '" + (dir / "shared").native() +
                                           "': in the folder '" + dir.path().native() +
                                           "' only its owner may replace a file";
              return openError(dir / "shared") == expected && openError(dir / "mine") == "no error" ? 0 : 1;
            }),
            0);
  EXPECT_EQ(readFile(dir / "shared"), "precious");
}

TEST(AtomicFile, ErrorsOfADiskAreWorthARetryAndOthersAreNot) {
  const auto codeOf = [](int error) { return fileError(error, "out/x.mp4").code(); };
  for (const int error : {ENOSPC, EDQUOT, EFBIG, EIO, EMFILE, ENFILE, ENOMEM, EBUSY}) {
    EXPECT_EQ(codeOf(error), ExitCode::Transient) << error;
  }
  for (const int error : {EACCES, EPERM, ENOENT, ENOTDIR, EISDIR, EROFS, ENAMETOOLONG, ELOOP}) {
    EXPECT_EQ(codeOf(error), ExitCode::BadInput) << error;
  }
  EXPECT_STREQ(fileError(ENOSPC, "out/x.mp4").what(),
               "cannot write 'out/x.mp4': no space left on the disk that holds 'out'");
  EXPECT_STREQ(fileError(EROFS, "x.mp4").what(),
               "cannot write 'x.mp4': the folder '.' is on a read-only file system");
}

TEST(AtomicFile, FileLimitIsTransientAndLeavesNothing) {
  const TempDir dir;
  EXPECT_EQ(inChild([&dir] {
              std::signal(SIGXFSZ, SIG_IGN);
              const rlimit limit{1000, 1000};
              setrlimit(RLIMIT_FSIZE, &limit);
              const std::string error = errorOf([&dir] {
                AtomicFile file(dir / "a");
                file.write(std::string(3000, 'x')); // a short write of 1000 bytes, then EFBIG
              });
              return error.starts_with("75: ") && error.find("largest size") != std::string::npos ? 0 : 1;
            }),
            0);
  EXPECT_THAT(dir.names(), IsEmpty());
}

TEST(AtomicFile, WritesThroughSymbolicLinks) {
  const TempDir dir;
  fs::create_directory(dir / "real");
  writeFile(dir / "real/target", "old");
  fs::create_symlink("real/target", dir / "relative");
  fs::create_symlink(dir / "relative", dir / "chain");
  fs::create_symlink("real/new", dir / "dangling");
  for (const char* name : {"chain", "dangling"}) {
    AtomicFile file(dir / name);
    file.write(name);
    EXPECT_EQ(file.temporary().parent_path().filename(), "real") << "must lie on the target's file system";
    file.commit();
    EXPECT_TRUE(fs::is_symlink(dir / name)) << name;
  }
  EXPECT_EQ(readFile(dir / "real/target"), "chain");
  EXPECT_EQ(readFile(dir / "real/new"), "dangling");
  EXPECT_THAT(dir.names("real"), ElementsAre("new", "target"));
}

TEST(AtomicFile, TakesPermissionsFromTheOlderFileOrTheUmask) {
  const TempDir dir;
  const mode_t old = umask(027);
  AtomicFile fresh(dir / "fresh");
  fresh.commit();
  writeFile(dir / "shared", "");
  chmod((dir / "shared").c_str(), 0666);
  AtomicFile shared(dir / "shared");
  shared.commit();
  umask(old);
  EXPECT_EQ(modeOf(dir / "fresh"), 0640U);
  EXPECT_EQ(modeOf(dir / "shared"), 0666U);
}

TEST(AtomicFile, LongNamesAndLeftoversDoNotDisturb) {
  const TempDir dir;
  std::string name;
  while (name.size() < 254) name += "é";
  AtomicFile longest(dir / name);
  longest.commit();
  EXPECT_TRUE(fs::exists(dir / name));

  const std::string stale = fmt::format(".a.{}.partial", getpid());
  writeFile(dir / stale, "of another run");
  AtomicFile file(dir / "a");
  AtomicFile twin(dir / "a");
  EXPECT_NE(file.temporary(), twin.temporary());
  file.write("file");
  twin.write("twin");
  file.commit();
  EXPECT_EQ(readFile(dir / "a"), "file");
  twin.commit();
  EXPECT_EQ(readFile(dir / "a"), "twin");
  EXPECT_EQ(readFile(dir / stale), "of another run");
}

TEST(AtomicFile, OnlyAbandonedTemporariesOfTheNamesAskedForAreRemoved) {
  const TempDir dir;
  const std::vector<std::string> left{".a.mp4.12345.partial", ".a.mp4.12345.2.partial"};
  const std::vector<std::string> others{".b.mp4.12345.partial", "a.mp4.12345.partial", ".a.mp4.partial",
                                        ".a.mp4.x1.partial", ".a.mp4.12345.partial.bak"};
  for (const auto& names : {left, others})
    for (const std::string& name : names) dir.write(name, "x");
  AtomicFile living(dir / "a.mp4");
  removeAbandoned(dir.path(), [](std::string_view name, bool whole) { return whole && name == "a.mp4"; });
  for (const std::string& name : left) EXPECT_FALSE(fs::exists(dir / name)) << name;
  for (const std::string& name : others) EXPECT_TRUE(fs::exists(dir / name)) << name;
  EXPECT_TRUE(fs::exists(living.temporary()));
  living.commit();
  removeAbandoned(dir / "missing", [](std::string_view, bool) { return true; }); // is no error
}

TEST(AtomicFile, AbandonedTemporariesOfLongNamesAreFoundByTheirBeginning) {
  const TempDir dir;
  for (const std::string letter : {"a", "é"}) {
    std::string name;
    while (name.size() + letter.size() <= NAME_MAX - 4) name += letter;
    name += ".mp4";
    std::vector<std::string> left;
    { // as a killed process leaves them: there, and not locked
      const AtomicFile first(dir / name);
      const AtomicFile second(dir / name);
      for (const AtomicFile* file : {&first, &second}) left.push_back(file->temporary().filename().native());
    }
    for (const std::string& file : left) dir.write(file, "x");
    const std::string other = ".b" + left.front().substr(2);
    dir.write(other, "x");
    AtomicFile living(dir / name);
    removeAbandoned(dir.path(), [&](std::string_view found, bool whole) {
      return whole ? found == name : std::string_view(name).starts_with(found);
    });
    EXPECT_TRUE(fs::exists(living.temporary()));
    for (const std::string& file : left)
      EXPECT_FALSE(fs::exists(dir / file)) << file.size() << " bytes: " << file;
    EXPECT_TRUE(fs::exists(dir / other));
    fs::remove(dir / other);
  }
}

TEST(AtomicFile, ForkedCopyRemovesNothing) {
  const TempDir dir;
  std::optional<AtomicFile> file;
  file.emplace(dir / "a");
  file->write("kept");
  EXPECT_EQ(inChild([&file] {
              removeTemporariesFromSignalHandler();
              file.reset();
              return 0;
            }),
            0);
  file->commit();
  EXPECT_EQ(readFile(dir / "a"), "kept");
}

void removeAndExit(int /*signal*/) {
  removeTemporariesFromSignalHandler();
  _exit(130);
}

TEST(AtomicFile, SignalHandlerRemovesEveryTemporaryOfTheProcess) {
  const TempDir dir;
  EXPECT_EQ(inChild([&dir] {
              chdir(dir.path().c_str());
              std::vector<std::unique_ptr<AtomicFile>> files;
              files.reserve(105);
              for (int i = 0; i < 100; ++i)
                files.push_back(std::make_unique<AtomicFile>(fmt::format("f{}", i)));
              files[3]->commit();
              files.erase(files.begin() + 10, files.begin() + 20); // their records are used again
              for (int i = 0; i < 5; ++i)
                files.push_back(std::make_unique<AtomicFile>(fmt::format("g{}", i)));
              chdir("/");
              std::signal(SIGINT, removeAndExit);
              std::raise(SIGINT);
              return 0;
            }),
            130);
  EXPECT_THAT(dir.names(), ElementsAre("f3"));
}

TEST(AtomicFile, CommitAfterTheTemporaryVanishedIsAnError) {
  const TempDir dir;
  AtomicFile file(dir / "a");
  fs::remove(file.temporary());
  EXPECT_THAT(errorOf([&file] { file.commit(); }), HasSubstr("cannot write"));
  EXPECT_THAT(dir.names(), IsEmpty());
}

TEST(AtomicFile, RequireWritableLeavesNothingBehind) {
  const TempDir dir;
  writeFile(dir / "a", "old");
  requireWritable(dir / "a");
  requireWritable(dir / "b");
  EXPECT_THAT(dir.names(), ElementsAre("a"));
  EXPECT_EQ(readFile(dir / "a"), "old");
}

} // namespace
} // namespace offstage
