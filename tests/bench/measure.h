#pragma once

#include <cstddef>
#include <fstream>
#include <malloc.h>
#include <string>
#include <sys/resource.h>

namespace offstage::bench {

/// CPU time of this process so far, user and system, in s.
inline double cpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// The most resident memory that this process has had, in KiB.
inline std::size_t peakKib() {
  std::ifstream status("/proc/self/status");
  std::string word;
  std::size_t kib = 0;
  while (status >> word)
    if (word == "VmHWM:") status >> kib;
  return kib;
}

/// Gives back what is free and forgets the peak: peakKib() is then what is resident now. Where the kernel
/// does not let a process do so the peak stays.
inline void restartPeak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5; // proc(5)
}

} // namespace offstage::bench
