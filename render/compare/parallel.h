#pragma once

#include <functional>

namespace offstage {

/// Threads that a comparison uses unless told otherwise: one a processor.
int defaultThreads();

/// Splits 0 … count into parts of at most `part` and calls work(worker, begin, end) for each, on `threads`
/// threads (the calling one among them), `worker` being 0 … threads − 1. Which worker gets which part is left
/// to chance: results must not depend on it. The first exception is thrown again here.
void parallelFor(int count, int part, int threads, const std::function<void(int, int, int)>& work);

} // namespace offstage
