#include "render/output/raw_sink.h"

#include "render/output/file_error.h"
#include "render/output/frame_check.h"
#include "src/sim/error.h"

#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <fmt/format.h>

namespace offstage {

namespace {

/// Waits until a descriptor that another program has made non-blocking takes bytes again; false when a signal
/// came before.
bool waitUntilWritable(int descriptor) {
  pollfd entry{descriptor, POLLOUT, 0};
  if (poll(&entry, 1, -1) >= 0) return true;
  if (errno != EINTR) throw standardOutputError(errno);
  return false;
}

} // namespace

RawFileSink::RawFileSink(const std::filesystem::path& path, const SinkFormat& format)
    : file_(path), format_(format) {}

void RawFileSink::write(const Frame& frame, const FrameTiming& /*timing*/) {
  requireFrameSize(frame, format_.width, format_.height);
  file_.write(frame.rgba.data(), frame.rgba.size());
  bytes_ += static_cast<std::int64_t>(frame.rgba.size());
}

void RawFileSink::finish() {
  if (bytes_ == 0)
    throw Error(ExitCode::BadInput, fmt::format("no frames to write to {}", quoted(file_.path())));
  file_.commit();
}

RawPipeSink::RawPipeSink(int descriptor, const SinkFormat& format)
    : descriptor_(descriptor), format_(format) {
  const int mode = fcntl(descriptor, F_GETFL);
  if (mode < 0) throw standardOutputError(errno);
  if ((mode & O_ACCMODE) == O_RDONLY) throw standardOutputError(EBADF);
  if (isatty(descriptor) != 0) {
    throw Error(ExitCode::BadInput,
                "standard output is a terminal; pipe the raw frames into a program, or name a file");
  }
}

void RawPipeSink::write(const Frame& frame, const FrameTiming& /*timing*/) {
  requireFrameSize(frame, format_.width, format_.height);
  const std::uint8_t* bytes = frame.rgba.data();
  std::size_t size = frame.rgba.size();
  while (size > 0) {
    const ssize_t written = ::write(descriptor_, bytes, size);
    if (written < 0) {
      if (errno == EINTR) {
        tellSignal();
        continue;
      }
      if (errno != EAGAIN && errno != EWOULDBLOCK) throw standardOutputError(errno);
      if (!waitUntilWritable(descriptor_)) tellSignal();
      continue;
    }
    bytes += written;
    size -= static_cast<std::size_t>(written);
    bytes_ += written;
    if (size > 0) tellSignal(); // a signal ends a write() that has written some
  }
}

void RawPipeSink::finish() {
  if (bytes_ == 0) throw Error(ExitCode::BadInput, "no frames to write to standard output");
}

} // namespace offstage
