#include "render/job/console.h"
#include "tests/support/child.h"
#include "tests/support/test_frames.h"

#include <cerrno>
#include <fcntl.h>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>

namespace offstage {
namespace {

using test::errorOf;
using test::inChild;

TEST(Console, NobodyToListenIsNoError) {
  std::FILE* full = std::fopen("/dev/full", "w");
  ASSERT_NE(full, nullptr);
  say(full, "something");
  EXPECT_EQ(std::ferror(full), 0);
  std::fclose(full);
}

TEST(Console, LostResultsAreOneUnlessTheCallerWantsNone) {
  const auto errorBehind = [](const char* device) {
    return inChild([device] {
      if (std::freopen(device, "w", stdout) == nullptr) return 1;
      std::fputs("a list", stdout);
      const std::string error = errorOf([] { requireResultsWritten(); });
      if (error == "no error") return 2;
      return error == "75: cannot write to standard output: no space left on its disk" ? 3 : 4;
    });
  };
  EXPECT_EQ(errorBehind("/dev/null"), 2);
  EXPECT_EQ(errorBehind("/dev/full"), 3);
  EXPECT_EQ(inChild([] {
              close(STDOUT_FILENO);
              std::fputs("a list", stdout);
              return errorOf([] { requireResultsWritten(); }) == "no error" ? 0 : 1;
            }),
            0);
}

TEST(Console, OutputFilesGetNoStandardNumber) {
  EXPECT_EQ(inChild([] {
              for (int stream = 0; stream <= 2; ++stream) close(stream);
              occupyStandardStreams();
              if (open("/dev/null", O_RDWR | O_CLOEXEC) <= STDERR_FILENO) return 1;
              char byte = 0;
              if (read(0, &byte, 1) != -1 || errno != EBADF) return 2;
              if (write(1, &byte, 1) != -1 || errno != EBADF) return 3;
              return write(2, &byte, 1) == -1 && errno == EBADF ? 0 : 4;
            }),
            0);
}

TEST(Console, OnlyATerminalHasColumns) {
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  EXPECT_EQ(terminalColumns(file), 0);
  std::fclose(file);
}

} // namespace
} // namespace offstage
