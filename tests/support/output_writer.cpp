#include "tests/support/output_writer.h"

#include "render/output/chunk_plan.h"
#include "render/output/chunked_output.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_frames.h"

#include <memory>

namespace offstage::test {

std::vector<FrameTiming> timingsOf(const std::vector<std::int64_t>& durations) {
  std::vector<FrameTiming> timings;
  timings.reserve(durations.size());
  std::int64_t time = 0;
  for (const std::int64_t duration : durations) {
    timings.push_back({static_cast<std::int64_t>(timings.size()), time, time + duration});
    time += duration;
  }
  return timings;
}

std::vector<FrameTiming> fixedTimings(int count, double fps) {
  std::vector<FrameTiming> timings;
  timings.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) timings.push_back(fixedTiming(k, fps));
  return timings;
}

Written writeOutput(const std::filesystem::path& out, const SinkFormat& format,
                    const std::vector<FrameTiming>& timings, const std::function<Frame(int)>& frameOf,
                    const std::function<void(std::int64_t joined)>& joinWatch) {
  const std::unique_ptr<ChunkedOutput> output = makeChunkedOutput(out, format);
  const TempDir folder;
  const ChunkPlan plan(static_cast<std::int64_t>(timings.size()));
  std::vector<std::filesystem::path> chunks;
  for (std::int64_t chunk = 0; chunk < plan.chunks(); ++chunk) {
    chunks.push_back(folder / std::to_string(chunk));
    const std::unique_ptr<ChunkWriter> writer = output->begin(chunks.back(), plan.begin(chunk));
    for (std::int64_t index = plan.begin(chunk); index < plan.begin(chunk + 1); ++index) {
      const int k = static_cast<int>(index);
      writer->write(frameOf ? frameOf(k) : lectureFrame(format.width, format.height, k),
                    timings.at(static_cast<std::size_t>(index)));
    }
    writer->finish();
  }
  output->setJoinWatch(joinWatch);
  Written written;
  written.bytes = output->join(chunks, plan.frames());
  written.notice = output->notice();
  return written;
}

} // namespace offstage::test
