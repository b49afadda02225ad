#include "render/compare/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace offstage {

int defaultThreads() {
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 64);
}

void parallelFor(int count, int part, int threads, const std::function<void(int, int, int)>& work) {
  const int parts = (count + part - 1) / part;
  threads = std::clamp(threads, 1, std::max(1, parts));
  std::atomic<int> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto run = [&](int worker) {
    try {
      for (int index = next++; index < parts; index = next++)
        work(worker, index * part, std::min(count, (index + 1) * part));
    } catch (...) {
      next = parts;
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (int worker = 1; worker < threads; ++worker) others.emplace_back(run, worker);
    run(0);
  }
  if (failure) std::rethrow_exception(failure);
}

} // namespace offstage
