#include "render/job/workers.h"

#include "render/job/child_process.h"
#include "render/job/interrupt.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr int kTickMs = 20;
constexpr int kMostFruitlessRounds = 3;

/// A pipe whose writing end every process of a round holds: its reading end ends when all of them have.
class LifeLine {
public:
  LifeLine() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw Error(ExitCode::Transient, fmt::format("no pipe: {}", std::generic_category().message(errno)));
  }
  ~LifeLine() {
    closeEnd(0);
    closeEnd(1);
  }
  LifeLine(const LifeLine&) = delete;
  LifeLine& operator=(const LifeLine&) = delete;

  void letGo() { closeEnd(1); } ///< in the parent, after the fork
  /// Whether every process has ended; waits so long at most.
  [[nodiscard]] bool ended(int milliseconds) const {
    pollfd entry{ends_[0], POLLIN, 0};
    return poll(&entry, 1, milliseconds) > 0 && (entry.revents & POLLHUP) != 0;
  }

private:
  void closeEnd(std::size_t end) {
    if (ends_.at(end) >= 0) close(ends_.at(end));
    ends_.at(end) = -1;
  }
  std::array<int, 2> ends_{-1, -1};
};

/// The simulating process's side: it steps, and forks workers.
class Simulator {
public:
  Simulator(const ChunkJob& job, Source& source, int jobs) : job_(job), source_(source), jobs_(jobs) {}

  void run(const std::vector<std::int64_t>& chunks) {
    for (const std::int64_t chunk : chunks) {
      const std::int64_t wanted = job_.firstSimulated(chunk);
      while (source_.frame() < wanted) source_.step();
      while (workers_ >= jobs_) reap();
      start(chunk);
    }
    while (workers_ > 0) reap();
  }

private:
  void start(std::int64_t chunk) {
    while (true) {
      try {
        forkChild(job_.state, [&] {
          FrameMaker frames(source_, job_.schedule);
          makeChunk(job_, chunk, frames);
        });
        ++workers_;
        return;
      } catch (const Error&) {
        if (workers_ == 0) throw;
        reap(); // the system allows fewer processes than asked for
      }
    }
  }

  void reap() {
    int status = 0;
    pid_t ended = -1;
    while ((ended = waitpid(-1, &status, 0)) < 0 && errno == EINTR) {
    }
    if (ended < 0) {
      workers_ = 0;
      return;
    }
    --workers_;
    if (WIFSIGNALED(status)) job_.state.setSignal(WTERMSIG(status));
    if (job_.state.failed()) _exit(1); // and the other workers with it
  }

  const ChunkJob& job_;
  Source& source_;
  int jobs_;
  int workers_ = 0;
};

/// One process that simulates, and its workers.
class Round {
public:
  Round(const ChunkJob& job, const std::vector<std::int64_t>& chunks, Source& source, int jobs)
      : state_(job.state) {
    simulator_ = forkChild(job.state, [&] { Simulator(job, source, jobs).run(chunks); });
    line_.letGo();
  }
  /// Ends all of them, if they have not.
  ~Round() {
    if (simulator_ > 0) {
      kill(simulator_, SIGKILL);
      waitFor(simulator_);
    }
    while (!line_.ended(-1)) {
    }
  }
  Round(const Round&) = delete;
  Round& operator=(const Round&) = delete;

  void await(const std::function<void()>& tick) {
    while (!line_.ended(kTickMs)) {
      throwIfInterrupted();
      state_.rethrow();
      tick();
    }
    const int status = waitFor(simulator_);
    simulator_ = -1;
    if (WIFSIGNALED(status)) state_.setSignal(WTERMSIG(status));
    throwIfInterrupted();
    state_.rethrow();
    tick();
  }

private:
  SharedState& state_;
  LifeLine line_;
  pid_t simulator_ = -1;
};

std::vector<std::int64_t> withoutFile(const ChunkJob& job, const std::vector<std::int64_t>& chunks) {
  std::vector<std::int64_t> missing;
  std::ranges::copy_if(chunks, std::back_inserter(missing),
                       [&](std::int64_t chunk) { return !std::filesystem::exists(job.parts.chunk(chunk)); });
  return missing;
}

[[noreturn]] void giveUp(const ChunkJob& job, std::int64_t chunk) {
  const int signal = job.state.signal();
  throw Error(
      ExitCode::Transient,
      fmt::format("the worker that makes frames {} to {} was ended {} times{}{}", job.plan.begin(chunk),
                  job.plan.begin(chunk + 1) - 1, kMostFruitlessRounds,
                  signal > 0 ? fmt::format(", last by signal {} ({})", signal, strsignal(signal)) : "",
                  signal == SIGKILL ? "; is memory short? Try fewer --jobs" : ""));
}

} // namespace

void makeChunksWithWorkers(const ChunkJob& job, const std::vector<std::int64_t>& chunks, Source& source,
                           int jobs, const std::function<void()>& tick) {
  std::vector<std::int64_t> missing = chunks;
  for (int fruitless = 0; !missing.empty();) {
    if (fruitless == kMostFruitlessRounds) giveUp(job, missing.front());
    Round(job, missing, source, jobs).await(tick);
    std::vector<std::int64_t> left = withoutFile(job, missing);
    fruitless = left.size() == missing.size() ? fruitless + 1 : 0;
    missing = std::move(left);
  }
}

} // namespace offstage
