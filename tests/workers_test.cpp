#include "render/job/workers.h"
#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

#include <algorithm>
#include <chrono>
#include <fcntl.h>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace offstage::test {
namespace {

/// An empty picture, and a simulation whose every step takes a while.
class SlowSource : public Source {
public:
  SlowSource(std::int64_t frames, std::chrono::microseconds step)
      : clock_(Clock::fixed(60.0, frames)), step_(step) {}

  [[nodiscard]] const Clock& clock() const override { return clock_; }
  [[nodiscard]] const std::string& title() const override { return title_; }
  [[nodiscard]] std::int64_t frame() const override { return frame_; }
  void step() override {
    std::this_thread::sleep_for(step_);
    ++frame_;
  }
  void draw(Picture& picture) const override {
    picture = {};
    picture.width = 16;
    picture.height = 16;
  }
  [[nodiscard]] std::uint64_t stateHash() const override { return 0; }
  [[nodiscard]] std::uint64_t fingerprint() const override { return 0; }

private:
  Clock clock_;
  std::chrono::microseconds step_;
  std::string title_;
  std::int64_t frame_ = 0;
};

/// Writes down which process begins which chunk, one line each, in order.
class WatchedOutput : public ChunkedOutput {
public:
  explicit WatchedOutput(std::filesystem::path log) : log_(std::move(log)) {}

  [[nodiscard]] std::string description() const override { return "watched"; }
  [[nodiscard]] std::unique_ptr<ChunkWriter> begin(const std::filesystem::path& file,
                                                   std::int64_t firstFrame) const override {
    const std::string line = std::to_string(firstFrame) + " " + std::to_string(getpid()) + "\n";
    const int log = open(log_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    EXPECT_EQ(write(log, line.data(), line.size()), static_cast<ssize_t>(line.size()));
    close(log);
    return std::make_unique<Writer>(file);
  }
  [[nodiscard]] bool isWhole(const std::filesystem::path& file) const override {
    return std::filesystem::exists(file);
  }
  std::int64_t join(std::span<const std::filesystem::path> /*chunks*/, std::int64_t /*frames*/) override {
    return 0;
  }

private:
  class Writer : public ChunkWriter {
  public:
    explicit Writer(std::filesystem::path file) : file_(std::move(file)) {}
    void write(const Frame& /*frame*/, const FrameTiming& /*timing*/) override {}
    void skip(const FrameTiming& /*timing*/) override {}
    void finish() override { writeFile(file_, "whole"); }
    [[nodiscard]] std::int64_t bytesWritten() const override { return 5; }

  private:
    std::filesystem::path file_;
  };

  std::filesystem::path log_;
};

/// Who began which chunk, in order of time.
struct Begun {
  std::int64_t chunk = 0;
  int process = 0;
};

std::vector<Begun> makeAll(std::int64_t frames, std::chrono::microseconds step, int jobs) {
  const TempDir dir;
  SlowSource source(frames, step);
  const Schedule schedule(source.clock(), {}, {}, {});
  const ChunkPlan plan(schedule.frames());
  const WatchedOutput output(dir / "log");
  Manifest manifest;
  manifest.add("scene", "none");
  Parts parts(dir / "out.mp4", manifest, Parts::Use::Whole, false);
  SharedState state(plan.chunks());
  std::vector<std::int64_t> chunks(static_cast<std::size_t>(plan.chunks()));
  std::iota(chunks.begin(), chunks.end(), 0);
  static_cast<void>(
      makeChunksWithWorkers({schedule, plan, output, parts, state, false}, chunks, source, jobs, [] {}));
  EXPECT_EQ(state.frames(), frames);
  parts.removeAll();

  std::vector<Begun> begun;
  std::istringstream lines(readFile(dir / "log"));
  for (Begun line; lines >> line.chunk >> line.process;) {
    line.chunk =
        std::ranges::find(chunks, line.chunk, [&](std::int64_t i) { return plan.begin(i); }) - chunks.begin();
    begun.push_back(line);
  }
  return begun;
}

std::set<int> processesOf(const std::vector<Begun>& begun) {
  std::set<int> processes;
  for (const Begun& line : begun) processes.insert(line.process);
  return processes;
}

std::vector<std::int64_t> chunksOf(const std::vector<Begun>& begun) {
  std::vector<std::int64_t> chunks;
  chunks.reserve(begun.size());
  for (const Begun& line : begun) chunks.push_back(line.chunk);
  return chunks;
}

TEST(Workers, GoOnWithFurtherChunksWhereStepsAreQuick) {
  const std::vector<Begun> alone = makeAll(960, std::chrono::microseconds(0), 1);
  EXPECT_EQ(chunksOf(alone), (std::vector<std::int64_t>{0, 1, 2, 3}));
  EXPECT_EQ(processesOf(alone).size(), 1U);

  // Two workers, and one more when that which has made the last chunk ends.
  const std::vector<Begun> two = makeAll(1920, std::chrono::microseconds(0), 2);
  EXPECT_EQ(two.size(), 8U);
  EXPECT_LE(processesOf(two).size(), 3U);
}

TEST(Workers, TheLastChunkIsNotBegunLast) {
  const std::vector<std::int64_t> order = chunksOf(makeAll(1920, std::chrono::microseconds(0), 2));
  const auto place = std::ranges::find(order, 7) - order.begin();
  EXPECT_LT(place, 5) << "of the eight chunks";
  std::vector<std::int64_t> others = order;
  std::ranges::sort(others);
  EXPECT_EQ(others, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6, 7})) << "each once";
}

TEST(Workers, EndWhereSteppingOverWhatOthersMakeTakesLong) {
  // 240 steps of a millisecond are longer than a worker's start.
  const std::vector<Begun> begun = makeAll(960, std::chrono::microseconds(1000), 2);
  ASSERT_EQ(begun.size(), 4U);
  const auto processOf = [&](std::int64_t chunk) {
    return std::ranges::find(begun, chunk, &Begun::chunk)->process;
  };
  EXPECT_NE(processOf(0), processOf(2));
  EXPECT_NE(processOf(0), processOf(3));
  EXPECT_EQ(begun.back().chunk, 3) << "the simulation has not come to the last chunk before";
}

/// s, of all children that have been waited for, and theirs.
double childrensSeconds() {
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// What measures a render, or limits it, sees all of it: no worker is left to others when the command ends.
TEST(Workers, CountTheirProcessorTimeWithTheCommands) {
  const TempDir dir;
  const auto secondsWith = [&](const char* jobs) {
    const double before = childrensSeconds();
    const ProcessResult result = offstage({"render", scene("exercise2_bounce"), "--to", "4", "--size",
                                           "1280x960", "-o", dir / "%04d.png", "--jobs", jobs});
    EXPECT_EQ(result.status, 0) << result.err;
    return childrensSeconds() - before;
  };
  const double alone = secondsWith("0");
  EXPECT_GT(alone, 0.05);
  for (const char* jobs : {"1", "2"}) EXPECT_GT(secondsWith(jobs), 0.6 * alone) << jobs;
}

} // namespace
} // namespace offstage::test
