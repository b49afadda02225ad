#include "render/job/interrupt.h"

#include "render/output/atomic_file.h"
#include "src/sim/error.h"

#include <csignal>
#include <unistd.h>

namespace offstage {
namespace {

volatile std::sig_atomic_t pendingSignal = 0;

void onSignal(int signal) {
  if (pendingSignal != 0) {
    removeTemporariesFromSignalHandler();
    _exit(128 + signal);
  }
  pendingSignal = signal;
}

} // namespace

void installSignalHandlers() {
  struct sigaction action = {};
  action.sa_handler = onSignal;
  sigemptyset(&action.sa_mask);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    // Who has one ignored means it: nohup SIGHUP, a shell's script SIGINT for what runs in the background.
    struct sigaction inherited = {};
    if (sigaction(number, nullptr, &inherited) == 0 && inherited.sa_handler != SIG_IGN)
      sigaction(number, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void throwIfInterrupted() {
  if (const int signal = pendingSignal; signal != 0)
    throw Error(static_cast<ExitCode>(128 + signal), "interrupted: the output is not finished");
}

} // namespace offstage
