#include "render/output/raw_sink.h"
#include "tests/support/child.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"

#include <array>
#include <csignal>
#include <fcntl.h>
#include <string>
#include <thread>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace offstage {
namespace {

using test::errorOf;
using test::formatOf;
using test::noiseFrame;
using test::TempDir;
using testing::HasSubstr;
using testing::IsEmpty;

std::string bytesOf(const Frame& frame) {
  return {frame.rgba.begin(), frame.rgba.end()};
}

TEST(RawFile, HoldsTheFramesOneAfterAnother) {
  const TempDir dir;
  RawFileSink sink(dir / "a.raw", formatOf(7, 5));
  sink.write(noiseFrame(7, 5, 1), {0, 0, 1});
  sink.write(noiseFrame(7, 5, 2), {1, 1, 2});
  EXPECT_EQ(sink.bytesWritten(), 280);
  sink.finish();
  EXPECT_EQ(test::readFile(dir / "a.raw"), bytesOf(noiseFrame(7, 5, 1)) + bytesOf(noiseFrame(7, 5, 2)));
}

TEST(RawFile, LeavesNothingWithoutFinishOrWithoutFrames) {
  const TempDir dir;
  {
    RawFileSink sink(dir / "a.raw", formatOf(7, 5));
    sink.write(noiseFrame(7, 5, 1), {0, 0, 1});
  }
  EXPECT_THAT(errorOf([&dir] { RawFileSink(dir / "a.raw", formatOf(7, 5)).finish(); }),
              HasSubstr("2: no frames"));
  EXPECT_THAT(dir.names(), IsEmpty());
}

TEST(RawFile, RefusesFramesOfAnotherSize) {
  const TempDir dir;
  RawFileSink sink(dir / "a.raw", formatOf(7, 5));
  EXPECT_EQ(errorOf([&sink] {
              sink.write(noiseFrame(5, 7, 1), {0, 0, 1});
            }),
            "2: a frame of 5 × 7 px came to an output of 7 × 5 px");
}

TEST(RawPipe, ReaderGetsEveryByteOfALargeFrame) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  // Non-blocking, as a shell's other programs may have left it: writes are short or refused when the pipe is
  // full.
  ASSERT_EQ(fcntl(ends[1], F_SETFL, O_NONBLOCK), 0);
  const Frame frame = noiseFrame(400, 300, 1);
  std::string read;
  std::thread reader([&read, end = ends[0]] {
    std::array<char, 3000> buffer{};
    for (ssize_t size = 0; (size = ::read(end, buffer.data(), buffer.size())) > 0;) {
      read.append(buffer.data(), static_cast<std::size_t>(size));
    }
  });
  RawPipeSink sink(ends[1], formatOf(400, 300));
  sink.write(frame, {0, 0, 1});
  sink.finish();
  close(ends[1]);
  reader.join();
  close(ends[0]);
  EXPECT_TRUE(read == bytesOf(frame)) << read.size() << " bytes read of " << frame.rgba.size();
  EXPECT_EQ(sink.bytesWritten(), 480000);
}

TEST(RawPipe, ReaderThatGoesAwayIsACleanError) {
  EXPECT_EQ(test::inChild([] {
              std::signal(SIGPIPE, SIG_IGN);
              std::array<int, 2> ends{};
              if (pipe(ends.data()) != 0) return 1;
              close(ends[0]);
              RawPipeSink sink(ends[1], formatOf(4, 4));
              const std::string error = errorOf([&sink] { sink.write(noiseFrame(4, 4, 1), {0, 0, 1}); });
              return error == "75: the program that reads from standard output has closed the pipe" ? 0 : 2;
            }),
            0);
}

TEST(RawPipe, FullDiskBehindStandardOutputIsTransient) {
  const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
  ASSERT_GE(full, 0);
  RawPipeSink sink(full, formatOf(4, 4));
  EXPECT_EQ(errorOf([&sink] {
              sink.write(noiseFrame(4, 4, 1), {0, 0, 1});
            }),
            "75: cannot write to standard output: no space left on its disk");
  EXPECT_THAT(errorOf([&sink] { sink.finish(); }), HasSubstr("no frames"));
  close(full);
}

TEST(RawPipe, RefusesATerminal) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (terminal < 0) GTEST_SKIP() << "no terminal to refuse: this system has no pseudo-terminals (/dev/pts)";
  EXPECT_THAT(errorOf([terminal] { const RawPipeSink sink(terminal, formatOf(4, 4)); }),
              HasSubstr("2: standard output is a terminal"));
  close(terminal);
}

TEST(RawPipe, RefusesAClosedDescriptor) {
  const int descriptor = open("/dev/null", O_WRONLY | O_CLOEXEC);
  ASSERT_GE(descriptor, 0);
  close(descriptor);
  EXPECT_THAT(errorOf([descriptor] { const RawPipeSink sink(descriptor, formatOf(4, 4)); }),
              HasSubstr("2: cannot write to standard output: Bad file descriptor"));
}

} // namespace
} // namespace offstage
