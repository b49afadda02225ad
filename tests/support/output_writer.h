#pragma once

#include "render/output/sink.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace offstage::test {

/// Timings of frames that last so long, in ns, from 0 on.
std::vector<FrameTiming> timingsOf(const std::vector<std::int64_t>& durations);

/// Timings of frames 0 … count − 1 at a constant rate.
std::vector<FrameTiming> fixedTimings(int count, double fps);

/// What an output said and how large it became.
struct Written {
  std::int64_t bytes = 0;
  std::string notice;
};

/// Makes an output of frames as a render does: chunk by chunk by the plan, then joined. Without `frameOf`,
/// frame k is lectureFrame(width, height, k). `joinWatch` is the output's.
Written writeOutput(const std::filesystem::path& out, const SinkFormat& format,
                    const std::vector<FrameTiming>& timings, const std::function<Frame(int)>& frameOf = {},
                    const std::function<void(std::int64_t joined)>& joinWatch = {});

} // namespace offstage::test
