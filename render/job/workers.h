#pragma once

#include "render/job/chunk_job.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace offstage {

/// Makes the chunks with forked processes. The calling process stays where it is in the simulation and never
/// touches GL, so the same can be done again: one process, forked from it, steps `source`, and forks a worker
/// at the start of a missing chunk, at most `jobs` at a time. A worker inherits the world's state, replays
/// the chunk's frames, draws and encodes them. Where the simulation steps quickly over what others make, it
/// goes on with another chunk and keeps its GL context and its memory; else it ends, and the next is forked
/// where the simulating process has got to.
///
/// Chunks whose worker was killed are made again. Throws Error(Transient) when three rounds in a row have not
/// made a single chunk; the first error that a worker reports; Error when a signal has come (interrupt.h). No
/// process of it is left then. `tick` is called about fifty times a second.
///
/// Returns when the chunks are there. The processes may still be ending, which takes their memory some 10 ms;
/// what is returned waits for that where it goes. job.state has to live until then.
[[nodiscard]] std::shared_ptr<void> makeChunksWithWorkers(const ChunkJob& job,
                                                          const std::vector<std::int64_t>& chunks,
                                                          Source& source, int jobs,
                                                          const std::function<void()>& tick);

} // namespace offstage
