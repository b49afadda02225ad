#include "render/job/chunk_job.h"

#include "render/job/interrupt.h"
#include "render/output/atomic_file.h"

#include <optional>

namespace offstage {

void makeChunk(const ChunkJob& job, std::int64_t chunk, FrameMaker& frames,
               const std::function<void()>& tick) {
  const std::int64_t first = job.plan.begin(chunk);
  const std::int64_t end = job.plan.begin(chunk + 1);
  const std::unique_ptr<ChunkWriter> writer = job.output.begin(job.parts.chunk(chunk), first);
  std::optional<AtomicFile> hashes;
  if (job.hashes) hashes.emplace(job.parts.hashes(chunk));
  for (std::int64_t index = first; index < end; ++index) {
    throwIfInterrupted();
    const FrameTiming timing = job.schedule.timing(index);
    if (!hashes && !job.output.holds(timing)) { // of a .gif every other frame, at 60 a second
      writer->skip(timing);
    } else {
      const Frame& frame = frames.make(index);
      if (hashes) hashes->write(frames.hashLine());
      writer->write(frame, timing);
    }
    job.state.setProgress(chunk, index + 1 - first, writer->bytesWritten());
    if (tick) tick();
  }
  // The hashes first: a chunk that is there is there with them.
  if (hashes) hashes->commit();
  writer->finish();
  job.state.setProgress(chunk, end - first, writer->bytesWritten());
}

} // namespace offstage
