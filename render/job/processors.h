#pragma once

namespace offstage {

/// How many processors this process may use: those that it may be scheduled on (sched_getaffinity), less
/// where its control group allows less time (cgroup v2 cpu.max, rounded up). At least 1.
int availableProcessors();

} // namespace offstage
