#include "render/job/render_job.h"

#include "render/job/interrupt.h"
#include "render/job/schedule.h"
#include "render/output/atomic_file.h"
#include "render/output/sink.h"
#include "render/raster/canvas.h"
#include "src/sim/error.h"

#include <chrono>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include <fmt/format.h>

namespace offstage {
namespace {

/// `--hash FILE`: physics and pixels of every frame, so that a change can be told apart.
class HashFile {
public:
  explicit HashFile(const std::filesystem::path& path) : file_(path) {}
  void write(std::int64_t frame, std::uint64_t state, std::uint64_t pixels) {
    file_.write(fmt::format("{} {:016x} {:016x}\n", frame, state, pixels));
  }
  void finish() { file_.commit(); }

private:
  AtomicFile file_;
};

void printNotice(const std::string& notice) {
  std::istringstream lines(notice);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) fmt::print(stderr, "offstage: {}\n", line);
}

} // namespace

RenderResult render(Source& source, const RenderOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const bool resample = options.fps && !source.clock().isFixed();
  const Schedule schedule(source.clock(), options.from, options.to, resample ? options.fps : std::nullopt);

  Picture picture;
  source.draw(picture);

  // Everything that can be refused is refused here, before a frame costs time.
  std::unique_ptr<Sink> sink;
  std::string said; // of the sink's notice
  if (!options.out.empty()) {
    sink = makeSink(options.out, {picture.width, picture.height, picture.background.a != 255, schedule.fps(),
                                  source.title()});
    said = sink->notice();
    printNotice(said);
  }
  std::optional<HashFile> hashes;
  if (!options.hashFile.empty()) hashes.emplace(options.hashFile);
  Canvas canvas(picture.width, picture.height);

  Progress progress(options.progress, schedule.frames(), schedule.seconds());
  const auto bytes = [&] { return sink ? sink->bytesWritten() : 0; };
  Frame frame;
  std::int64_t drawn = -1; // the simulated frame that `frame` shows; resampling may show one twice
  for (std::int64_t index = 0; index < schedule.frames(); ++index) {
    throwIfInterrupted();
    const std::int64_t wanted = schedule.simulated(index);
    while (source.frame() < wanted) source.step();
    if (wanted != drawn) {
      source.draw(picture);
      canvas.draw(picture, frame);
      drawn = wanted;
    }
    if (hashes) hashes->write(wanted, source.stateHash(), frame.hash());
    if (sink) sink->write(frame, schedule.timing(index));
    progress.update(index + 1, bytes());
  }
  throwIfInterrupted();
  if (sink) {
    sink->finish();
    printNotice(sink->notice().substr(said.size())); // what only the whole told
  }
  if (hashes) hashes->finish();
  progress.finish(bytes());

  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return {schedule.frames(), schedule.seconds(), elapsed.count(), bytes()};
}

void requireOutput(const RenderOptions& options) {
  if (options.out.empty() && options.hashFile.empty())
    throw Error(ExitCode::BadInput, "nothing to make: give -o OUT (or --hash FILE)");
}

void printSummary(const RenderResult& result, const RenderOptions& options) {
  const std::filesystem::path& made = options.out.empty() ? options.hashFile : options.out;
  std::string text = fmt::format("{}: {} frames, {:.3f} s, in {:.2f} s ({:.1f}x real time)", made.string(),
                                 result.frames, result.seconds, result.elapsed,
                                 result.elapsed > 0.0 ? result.seconds / result.elapsed : 0.0);
  if (!options.out.empty()) text += fmt::format(", {} KiB", (result.bytes + 1023) / 1024);
  fmt::print(options.out == "-" ? stderr : stdout, "{}\n", text);
}

} // namespace offstage
