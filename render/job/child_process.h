#pragma once

#include "src/sim/error.h"

#include <functional>
#include <sys/types.h>

namespace offstage {

class SharedState;

/// Forks a process that runs `body` and ends. It is killed when the process that made it ends, for whatever
/// reason; Ctrl-C on the terminal is its parent's business. An exception of `body` becomes the error of
/// `state` and exit status 1. No destructor and no atexit handler of the parent runs in it. Throws
/// Error(Transient) when the system allows no more processes.
pid_t forkChild(SharedState& state, const std::function<void()>& body);

/// Waits for a child to end; its status as waitpid has it.
int waitFor(pid_t child);

} // namespace offstage
