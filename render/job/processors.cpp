#include "render/job/processors.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sched.h>
#include <string>

namespace offstage {
namespace {

/// Processors' worth of time that the control group allows; infinite without a limit.
double groupLimit() {
  std::ifstream file("/sys/fs/cgroup/cpu.max"); // "QUOTA PERIOD" in µs, or "max PERIOD"
  double quota = 0.0;
  double period = 0.0;
  if (file >> quota >> period && quota > 0.0 && period > 0.0) return quota / period;
  return HUGE_VAL;
}

} // namespace

int availableProcessors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  const int scheduled = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
  return static_cast<int>(std::max(1.0, std::min<double>(scheduled, std::ceil(groupLimit()))));
}

} // namespace offstage
