#pragma once

#include "render/output/sink.h"
#include "render/raster/frame.h"

#include <cstdint>

namespace offstage {

/// Throws Error(BadInput) unless width and height are at least 1 px.
void requirePictureSize(int width, int height);

/// Throws Error(BadInput) unless the frame has at least one pixel and its buffer holds exactly its pixels.
void requireWholeFrame(const Frame& frame);

/// The same, and the size must be width × height: what every output asks of each frame.
void requireFrameSize(const Frame& frame, int width, int height);

/// Holds frames to their order: numbered without a gap, each shown from the end of the one before it on.
class FrameOrder {
public:
  /// With a constant rate (`timed` = false) only the numbers count.
  FrameOrder(std::int64_t firstFrame, bool timed) : next_(firstFrame), timed_(timed) {}
  void require(const FrameTiming& timing); ///< throws Error(BadInput)

private:
  std::int64_t next_;
  bool timed_;
  bool first_ = true;
  std::int64_t end_ = 0; ///< ns
};

} // namespace offstage
