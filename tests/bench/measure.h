#pragma once

#include <cstddef>
#include <fstream>
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

} // namespace offstage::bench
