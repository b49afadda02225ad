#pragma once

#include "render/job/frame_maker.h"
#include "render/job/parts.h"
#include "render/job/schedule.h"
#include "render/job/shared_state.h"
#include "render/job/source.h"
#include "render/output/chunk_plan.h"
#include "render/output/chunked_output.h"

#include <cstdint>
#include <functional>

namespace offstage {

/// What all chunks of a render have in common.
struct ChunkJob {
  const Schedule& schedule;
  const ChunkPlan& plan;
  const ChunkedOutput& output;
  const Parts& parts;
  SharedState& state;
  bool hashes = false; ///< also write the chunk's lines of `--hash`

  /// The simulated frame that a chunk begins with.
  [[nodiscard]] std::int64_t firstSimulated(std::int64_t chunk) const {
    return schedule.simulated(plan.begin(chunk));
  }
};

/// Makes one chunk's files in this process; calls `tick`, if given, after every frame.
void makeChunk(const ChunkJob& job, std::int64_t chunk, FrameMaker& frames,
               const std::function<void()>& tick = {});

} // namespace offstage
