#include "render/output/frame_check.h"

#include "src/sim/error.h"

#include <cstddef>

#include <fmt/format.h>

namespace offstage {

void requirePictureSize(int width, int height) {
  if (width >= 1 && height >= 1) return;
  throw Error(ExitCode::BadInput, fmt::format("a picture of {} × {} px cannot be written", width, height));
}

void requireWholeFrame(const Frame& frame) {
  if (frame.width < 1 || frame.height < 1) {
    throw Error(ExitCode::BadInput,
                fmt::format("a frame of {} × {} px has no pixels", frame.width, frame.height));
  }
  const std::size_t bytes =
      static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height) * 4;
  if (frame.rgba.size() != bytes) {
    throw Error(ExitCode::BadInput, fmt::format("a frame of {} × {} px holds {} bytes instead of {}",
                                                frame.width, frame.height, frame.rgba.size(), bytes));
  }
}

void requireFrameSize(const Frame& frame, int width, int height) {
  requireWholeFrame(frame);
  if (frame.width != width || frame.height != height) {
    throw Error(ExitCode::BadInput, fmt::format("a frame of {} × {} px came to an output of {} × {} px",
                                                frame.width, frame.height, width, height));
  }
}

void FrameOrder::require(const FrameTiming& timing) {
  if (timing.index != next_)
    throw Error(ExitCode::BadInput, fmt::format("frame {} came where frame {} was due", timing.index, next_));
  if (timed_ && (timing.end < timing.start || timing.start < 0 || (!first_ && timing.start != end_))) {
    throw Error(ExitCode::BadInput,
                fmt::format("frame {} is shown from {} to {} ns, which does not follow the frame before it",
                            timing.index, timing.start, timing.end));
  }
  ++next_;
  first_ = false;
  end_ = timing.end;
}

} // namespace offstage
