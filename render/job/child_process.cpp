#include "render/job/child_process.h"

#include "render/job/shared_state.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

namespace offstage {
namespace {

int run(SharedState& state, const std::function<void()>& body) {
  try {
    body();
    return 0;
  } catch (const Error& error) {
    state.fail(error);
  } catch (const std::bad_alloc&) {
    state.fail(Error(ExitCode::Transient, "out of memory"));
  } catch (const std::exception& error) {
    state.fail(Error(ExitCode::BadInput, error.what()));
  } catch (...) {
    state.fail(Error(ExitCode::BadInput, "an exception of a type that is not std::exception's"));
  }
  return 1;
}

} // namespace

pid_t forkChild(SharedState& state, const std::function<void()>& body) {
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) {
    throw Error(ExitCode::Transient,
                fmt::format("cannot start a worker: {}", std::generic_category().message(errno)));
  }
  if (child > 0) return child;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1); // it ended before the line above
  std::signal(SIGINT, SIG_IGN);      // the parent hears it, too, and ends its children
  std::signal(SIGHUP, SIG_IGN);
  std::signal(SIGTERM, SIG_DFL);
  _exit(run(state, body));
}

int waitFor(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

} // namespace offstage
