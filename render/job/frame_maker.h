#pragma once

#include "render/job/schedule.h"
#include "render/job/source.h"
#include "render/raster/canvas.h"

#include <cstdint>

namespace offstage {

/// Draws the frames of an output one after another: steps the source to each and draws it. Makes its canvas
/// at once, so in a process that forks it is made after the fork.
class FrameMaker {
public:
  FrameMaker(Source& source, const Schedule& schedule);

  /// The frame of the output with this number, valid until the next call; numbers only rise.
  const Frame& make(std::int64_t index);
  /// `frame state-hash pixel-hash` of the frame that make() gave, with a newline: a line of `--hash`.
  [[nodiscard]] std::string hashLine() const;

private:
  Source& source_;
  const Schedule& schedule_;
  Picture picture_;
  Canvas canvas_;
  Frame frame_;
  std::int64_t drawn_ = -1; ///< the simulated frame that frame_ shows; resampling may show one twice
};

/// The source's present picture, for its size and background.
Picture pictureOf(const Source& source);

} // namespace offstage
