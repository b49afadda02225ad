#pragma once

#include "render/job/schedule.h"
#include "render/job/source.h"
#include "render/raster/canvas.h"

#include <cstdint>
#include <optional>
#include <string>

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
  std::optional<Moment>
      drawn_; ///< what frame_ shows; resampling and pauses show one moment in several frames
};

/// The source's present picture, for its size and background.
Picture pictureOf(const Source& source);

} // namespace offstage
