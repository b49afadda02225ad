#include "render/job/workers.h"

#include "render/job/child_process.h"
#include "render/job/interrupt.h"
#include "render/raster/context.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <malloc.h>
#include <memory>
#include <optional>
#include <poll.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr int kTickMs = 20;
constexpr int kMostFruitlessRounds = 3;
/// How often the simulating process looks which chunks its workers have gone on with.
constexpr std::chrono::milliseconds kClaimsWatch{5};
/// s: what a worker's start takes: its GL context and shaders, and fresh memory for the encoder (measured at
/// 1080p with x264).
constexpr double kWorkerStart = 0.1;
/// Bytes from which on a worker's memory comes from the system, and goes back to it: glibc's own threshold,
/// which it would raise with every block that is freed.
constexpr int kLargeBlock = 1 << 17;

/// A pipe whose writing end every process of a round holds: its reading end ends when all of them have.
/// Through it the last chunk's worker tells that it has made it.
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

  void tellMade() const {
    const char word = 0;
    while (write(ends_[1], &word, 1) < 0 && errno == EINTR) {
    }
  }
  enum class State { Working, Made, Ended };
  /// Whether every chunk is made, or every process has ended; waits so long at most.
  [[nodiscard]] State watch(int milliseconds) const {
    pollfd entry{ends_[0], POLLIN, 0};
    char word = 0;
    if (poll(&entry, 1, milliseconds) <= 0) return State::Working;
    return read(ends_[0], &word, 1) > 0 ? State::Made : State::Ended;
  }
  /// Waits until every process has ended.
  void awaitEnd() const {
    char word = 0;
    while (true) {
      const ssize_t got = read(ends_[0], &word, 1);
      if (got == 0 || (got < 0 && errno != EINTR)) return;
    }
  }

private:
  void closeEnd(std::size_t end) {
    if (ends_.at(end) >= 0) close(ends_.at(end));
    ends_.at(end) = -1;
  }
  std::array<int, 2> ends_{-1, -1};
};

/// The side of a worker: it makes one chunk, and more while that is cheaper than another worker.
class Worker {
public:
  Worker(const ChunkJob& job, const std::vector<std::int64_t>& chunks, Source& source, int jobs,
         const LifeLine& line)
      : job_(job), chunks_(chunks), source_(source), jobs_(jobs), line_(line) {}

  /// Ends the process: what its GL context and the encoder's libraries hold goes with it, sooner than piece
  /// by piece.
  [[noreturn]] void run(std::int64_t first) {
    // Else an encoder's frames come from the heap once one has been freed, and leave holes there: two workers
    // took 446 MB instead of 399 for a minute at 1080p.
    mallopt(M_MMAP_THRESHOLD, kLargeBlock);
    FrameMaker frames(source_, job_.schedule);
    for (std::optional<std::int64_t> chunk = first; chunk; chunk = next(*chunk)) {
      makeChunk(job_, *chunk, frames);
      if (job_.state.countMade() == static_cast<std::int64_t>(chunks_.size())) line_.tellMade();
    }
    _exit(0);
  }

private:
  /// The chunk to go on with after `made`, claimed.
  [[nodiscard]] std::optional<std::int64_t> next(std::int64_t made) const {
    // What comes last is often what takes longest: bodies that have gathered, a picture that fades. Begun
    // last, it would be made alone, while the other workers have nothing to do.
    const std::int64_t last = chunks_.back();
    if (jobs_ > 1 && last > made && isNear(last) && job_.state.claim(last)) return last;
    for (const std::int64_t chunk : chunks_) {
      if (chunk <= made || job_.state.claimed(chunk)) continue;
      if (!isNear(chunk)) return std::nullopt;
      if (job_.state.claim(chunk)) return chunk;
    }
    return std::nullopt;
  }

  /// Whether stepping to the chunk takes no longer than starting a worker there.
  [[nodiscard]] bool isNear(std::int64_t chunk) const {
    const std::int64_t steps = job_.firstSimulated(chunk) - source_.frame();
    if (steps <= 1) return true; // the next one
    const double seconds = job_.state.stepSeconds();
    return seconds > 0.0 && static_cast<double>(steps) * seconds <= kWorkerStart;
  }

  const ChunkJob& job_;
  const std::vector<std::int64_t>& chunks_;
  Source& source_;
  int jobs_;
  const LifeLine& line_;
};

/// The simulating process's side: it steps, and forks workers.
class Simulator {
public:
  Simulator(const ChunkJob& job, const std::vector<std::int64_t>& chunks, Source& source, int jobs,
            const LifeLine& line)
      : job_(job), chunks_(chunks), source_(source), jobs_(jobs), line_(line) {}

  void run() {
    preloadGl(); // once for all workers
    for (const std::int64_t chunk : chunks_) {
      if (job_.state.claimed(chunk)) continue;
      stepTo(job_.firstSimulated(chunk));
      while (workers_ >= jobs_ && !job_.state.claimed(chunk)) {
        if (!reap(WNOHANG)) std::this_thread::sleep_for(kClaimsWatch);
      }
      if (job_.state.claim(chunk)) start(chunk);
    }
    while (workers_ > 0) reap();
  }

private:
  using SteadyClock = std::chrono::steady_clock;

  void stepTo(std::int64_t wanted) {
    const SteadyClock::time_point start = SteadyClock::now();
    const std::int64_t first = source_.frame();
    while (source_.frame() < wanted) source_.step();
    if (source_.frame() == first) return;
    seconds_ += SteadyClock::now() - start;
    steps_ += source_.frame() - first;
    job_.state.setStepSeconds(seconds_.count() / static_cast<double>(steps_));
  }

  void start(std::int64_t chunk) {
    while (true) {
      try {
        forkChild(job_.state, [&] { Worker(job_, chunks_, source_, jobs_, line_).run(chunk); });
        ++workers_;
        return;
      } catch (const Error&) {
        if (workers_ == 0) throw;
        reap(); // the system allows fewer processes than asked for
      }
    }
  }

  /// Takes note of a worker's end; waits for one, or tells with WNOHANG that none has ended.
  bool reap(int options = 0) {
    int status = 0;
    pid_t ended = -1;
    while ((ended = waitpid(-1, &status, options)) < 0 && errno == EINTR) {
    }
    if (ended == 0) return false;
    if (ended < 0) {
      workers_ = 0;
      return true;
    }
    --workers_;
    if (WIFSIGNALED(status)) job_.state.setSignal(WTERMSIG(status));
    if (job_.state.failed()) _exit(1); // and the other workers with it
    return true;
  }

  const ChunkJob& job_;
  const std::vector<std::int64_t>& chunks_;
  Source& source_;
  int jobs_;
  const LifeLine& line_;
  int workers_ = 0;
  std::chrono::duration<double> seconds_{}; ///< in steps
  std::int64_t steps_ = 0;
};

/// One process that simulates, and its workers.
class Round {
public:
  Round(const ChunkJob& job, const std::vector<std::int64_t>& chunks, Source& source, int jobs)
      : state_(job.state) {
    job.state.beginRound();
    simulator_ = forkChild(job.state, [&] { Simulator(job, chunks, source, jobs, line_).run(); });
    line_.letGo();
  }
  /// Ends all of them, if they have not. Where all is made they are left to end by themselves: the simulating
  /// process takes note of its workers, so that their processor time is counted with this one's.
  ~Round() {
    if (simulator_ > 0) {
      if (!made_) kill(simulator_, SIGKILL);
      waitFor(simulator_);
    }
    line_.awaitEnd();
  }
  Round(const Round&) = delete;
  Round& operator=(const Round&) = delete;

  void await(const std::function<void()>& tick) {
    LifeLine::State now{};
    while ((now = line_.watch(kTickMs)) == LifeLine::State::Working) {
      throwIfInterrupted();
      state_.rethrow();
      tick();
    }
    made_ = now == LifeLine::State::Made;
    if (now == LifeLine::State::Ended) {
      const int status = waitFor(simulator_);
      simulator_ = -1;
      if (WIFSIGNALED(status)) state_.setSignal(WTERMSIG(status));
    }
    throwIfInterrupted();
    state_.rethrow();
    tick();
  }

private:
  SharedState& state_;
  LifeLine line_;
  pid_t simulator_ = -1;
  bool made_ = false; ///< every chunk
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

std::shared_ptr<void> makeChunksWithWorkers(const ChunkJob& job, const std::vector<std::int64_t>& chunks,
                                            Source& source, int jobs, const std::function<void()>& tick) {
  std::vector<std::int64_t> missing = chunks;
  std::shared_ptr<Round> round;
  for (int fruitless = 0; !missing.empty();) {
    if (fruitless == kMostFruitlessRounds) giveUp(job, missing.front());
    round.reset(); // its processes end first
    round = std::make_shared<Round>(job, missing, source, jobs);
    round->await(tick);
    std::vector<std::int64_t> left = withoutFile(job, missing);
    fruitless = left.size() == missing.size() ? fruitless + 1 : 0;
    missing = std::move(left);
  }
  return round;
}

} // namespace offstage
