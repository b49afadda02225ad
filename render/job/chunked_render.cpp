#include "render/job/chunked_render.h"

#include "render/job/chunk_job.h"
#include "render/job/command_line.h"
#include "render/job/fingerprint.h"
#include "render/job/interrupt.h"
#include "render/job/left_out.h"
#include "render/job/notice.h"
#include "render/job/processors.h"
#include "render/job/sidecar.h"
#include "render/job/workers.h"
#include "render/output/atomic_file.h"
#include "render/output/file_error.h"
#include "render/output/frame_pattern.h"
#include "render/output/output_kind.h"
#include "render/raster/context.h"
#include "src/sim/error.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <iterator>
#include <numeric>

#include <fmt/format.h>

namespace offstage {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOptions = "options";
constexpr const char* kHashes = "hash file";

std::string programVersion() {
  Fingerprint program;
  program.addFile("/proc/self/exe");
  return fmt::format("{} {:016x}", OFFSTAGE_VERSION, program.value());
}

class ChunkedRender {
public:
  ChunkedRender(Source& source, const RenderOptions& options)
      : source_(source),
        options_(options),
        schedule_(scheduleOf(source, options)),
        plan_(schedule_.frames()),
        firstChunk_(share(0)),
        endChunk_(share(1)),
        output_(makeChunkedOutput(options.out, formatOf(source, options, schedule_))),
        state_(plan_.chunks()) {
    if (!options.hashFile.empty()) requireWritable(options.hashFile);
    if (source.hasCaptions() && !options.segment && Sidecar::nameFor(options.out))
      sidecar_.emplace(options.out);
    said_ = output_->notice();
    printNotice(said_);
    sayWhatIsLeftOut();
  }

  RenderResult render() {
    Parts parts(options_.out, manifest(!options_.hashFile.empty()),
                options_.segment ? Parts::Use::Segment : Parts::Use::Whole, options_.resume);
    printNotice(parts.notice());
    removeLeftovers();
    if (firstChunk_ == endChunk_) {
      // As many machines as asked for can run the same command, however short the scene.
      printNotice(fmt::format("segment {} of {} has nothing to make: the output has {} chunk{}",
                              options_.segment->number, options_.segment->count, plan_.chunks(),
                              plan_.chunks() == 1 ? "" : "s"));
      return {0, 0.0, elapsed(), 0};
    }
    const std::vector<std::int64_t> missing = missingChunks(parts);
    const std::int64_t there = endChunk_ - firstChunk_ - static_cast<std::int64_t>(missing.size());
    if (there > 0) {
      printNotice(fmt::format("going on with {} of {} chunks from {}", there, endChunk_ - firstChunk_,
                              quoted(parts.folder())));
    }
    const std::int64_t frames = plan_.begin(endChunk_) - plan_.begin(firstChunk_);
    Progress progress(options_.progress, frames, seconds(), state_.frames());
    makeMissing(parts, missing, progress);
    const auto watch = [&](std::int64_t /*joined*/) { progress.update(state_.frames(), state_.bytes()); };
    const std::int64_t bytes = options_.segment ? state_.bytes() : join(parts, watch);
    if (!options_.hashFile.empty()) writeHashes(parts);
    ending_.reset();                             // they hold the lock, too
    if (state_.signal() != 0) removeLeftovers(); // of workers that something ended
    if (!options_.segment) parts.removeAll();
    progress.finish(bytes);
    return {frames, seconds(), elapsed(), bytes};
  }

  RenderResult joinOnly() {
    const std::optional<Manifest> stored = Manifest::read(Parts::manifestFor(options_.out));
    const bool hashes = stored && stored->values(kHashes) == std::vector<std::string>{"yes"};
    const Manifest mine = manifest(hashes);
    if (!stored || *stored != mine) {
      throw Error(ExitCode::BadInput,
                  fmt::format("the parts in {} were made from something else, which differs in {}",
                              quoted(Parts::folderFor(options_.out)),
                              stored ? stored->differences(mine) : "the manifest"));
    }
    if (!hashes && !options_.hashFile.empty())
      throw Error(ExitCode::BadInput, "--hash: the segments were rendered without it");
    Parts parts(options_.out, mine, Parts::Use::Whole, true);
    if (const std::vector<std::int64_t> missing = missingChunks(parts); !missing.empty()) {
      throw Error(
          ExitCode::BadInput,
          fmt::format(
              "{} lacks {} of {} chunks, the first that of frames {} to {}: render all segments first",
              quoted(parts.folder()), missing.size(), plan_.chunks(), plan_.begin(missing.front()),
              plan_.begin(missing.front() + 1) - 1));
    }
    Progress progress(options_.progress, plan_.frames(), seconds());
    const std::int64_t bytes =
        join(parts, [&](std::int64_t joined) { progress.update(joined, state_.bytes()); });
    if (!options_.hashFile.empty()) writeHashes(parts);
    parts.removeAll();
    progress.finish(bytes);
    return {plan_.frames(), seconds(), elapsed(), bytes};
  }

private:
  /// What runs that were killed while they wrote OUT itself have left beside it.
  void removeLeftovers() const {
    if (!options_.hashFile.empty()) removeAbandoned(options_.hashFile);
    if (outputKind(options_.out) != OutputKind::PngSequence) return removeAbandoned(options_.out);
    const FramePattern pattern(placeOf(options_.out));
    removeAbandoned(pattern.folder(), [&](std::string_view name, bool whole) {
      return whole ? pattern.numberOf(name).has_value() : pattern.mayBeginWith(name);
    });
  }

  /// A recorded clock's frames may be shorter than the output can tell apart.
  void sayWhatIsLeftOut() const {
    if (schedule_.fps() > 0.0) return; // known to fit
    std::int64_t leftOut = 0;
    for (std::int64_t frame = plan_.begin(firstChunk_); frame < plan_.begin(endChunk_); ++frame)
      leftOut += output_->holds(schedule_.timing(frame)) ? 0 : 1;
    if (leftOut == 0) return;
    printNotice(fmt::format("{} of {} frames {} shorter than the unit of time of {}, and left out", leftOut,
                            plan_.begin(endChunk_) - plan_.begin(firstChunk_), leftOut == 1 ? "is" : "are",
                            quoted(options_.out.filename())));
  }

  using SteadyClock = std::chrono::steady_clock;

  static SinkFormat formatOf(const Source& source, const RenderOptions& options, const Schedule& schedule) {
    const Picture picture = pictureOf(source);
    return {picture.width,  picture.height, picture.background.a != 255,
            schedule.fps(), source.title(), options.quality};
  }

  /// The first chunk of the segment (side 0), or the one after its last (side 1).
  [[nodiscard]] std::int64_t share(std::int64_t side) const {
    const Segment segment = options_.segment.value_or(Segment{1, 1});
    return plan_.chunks() * (segment.number - 1 + side) / segment.count;
  }

  [[nodiscard]] Manifest manifest(bool hashes) const {
    Manifest manifest;
    manifest.add("program", programVersion());
    manifest.add("scene", fmt::format("{:016x}", source_.fingerprint()));
    for (const std::string& argument : options_.drawingArguments()) manifest.add(kOptions, argument);
    manifest.add("title", source_.title());
    manifest.add("frames", fmt::format("{} in {} chunks", plan_.frames(), plan_.chunks()));
    manifest.add("output", output_->description());
    manifest.add("driver", glDriver());
    manifest.add(kHashes, hashes ? "yes" : "no");
    return manifest;
  }

  std::vector<std::int64_t> missingChunks(Parts& parts) {
    std::vector<std::int64_t> missing;
    for (std::int64_t chunk = firstChunk_; chunk < endChunk_; ++chunk) {
      const fs::path file = parts.chunk(chunk);
      if (fs::exists(file) && output_->isWhole(file)) {
        state_.setProgress(chunk, plan_.begin(chunk + 1) - plan_.begin(chunk),
                           static_cast<std::int64_t>(fs::file_size(file)));
        continue;
      }
      parts.drop(chunk);
      missing.push_back(chunk);
    }
    return missing;
  }

  void makeMissing(const Parts& parts, const std::vector<std::int64_t>& missing, Progress& progress) {
    const ChunkJob job{schedule_, plan_, *output_, parts, state_, !options_.hashFile.empty()};
    const auto tick = [&] { progress.update(state_.frames(), state_.bytes()); };
    try {
      const int jobs = options_.jobs.value_or(availableProcessors());
      if (jobs > 0) {
        ending_ = makeChunksWithWorkers(job, missing, source_, jobs, tick);
      } else if (!missing.empty()) {
        FrameMaker frames(source_, schedule_);
        for (const std::int64_t chunk : missing) makeChunk(job, chunk, frames, tick);
      }
    } catch (const Error& error) {
      removeLeftovers(); // workers that were ended have left theirs
      throw Error(error.code(), error.what() + whatIsKept(parts, error.code()));
    }
  }

  /// For the message of an error: what the next run can use. Nothing when it would start over, or can never
  /// work.
  [[nodiscard]] std::string whatIsKept(const Parts& parts, ExitCode code) const {
    if (!options_.resume || code == ExitCode::BadInput) return {};
    std::int64_t kept = 0;
    for (std::int64_t chunk = firstChunk_; chunk < endChunk_; ++chunk)
      kept += fs::exists(parts.chunk(chunk)) ? 1 : 0;
    if (kept == 0) return {};
    return fmt::format("; {} of {} chunks are kept in {}: the same command goes on from there", kept,
                       endChunk_ - firstChunk_, quoted(parts.folder()));
  }

  std::int64_t join(const Parts& parts, const std::function<void(std::int64_t joined)>& watch) {
    output_->setJoinWatch([&watch](std::int64_t joined) {
      throwIfInterrupted();
      watch(joined);
    });
    try {
      return joinChunks(parts);
    } catch (const Error& error) {
      throw Error(error.code(), error.what() + whatIsKept(parts, error.code()));
    }
  }

  std::int64_t joinChunks(const Parts& parts) {
    std::vector<fs::path> chunks;
    for (std::int64_t chunk = 0; chunk < plan_.chunks(); ++chunk) chunks.push_back(parts.chunk(chunk));
    const VideoTracks tracks = source_.tracks(schedule_.origin(), schedule_.origin() + schedule_.seconds());
    printNotice(leftOutNotice(options_.out, tracks));
    output_->setTracks(tracks);
    const std::int64_t bytes = output_->join(chunks, plan_.frames());
    if (sidecar_)
      sidecar_->write(tracks);
    else
      Sidecar::removeStale(options_.out);
    printNotice(output_->notice().substr(said_.size())); // what only the whole told
    return bytes;
  }

  void writeHashes(const Parts& parts) const {
    AtomicFile file(options_.hashFile);
    for (std::int64_t chunk = firstChunk_; chunk < endChunk_; ++chunk) {
      std::ifstream stream(parts.hashes(chunk), std::ios::binary);
      file.write(std::string(std::istreambuf_iterator<char>(stream), {}));
    }
    file.commit();
  }

  [[nodiscard]] double seconds() const {
    return static_cast<double>(schedule_.timing(plan_.begin(endChunk_) - 1).end -
                               schedule_.timing(plan_.begin(firstChunk_)).start) /
           1e9;
  }
  [[nodiscard]] double elapsed() const {
    return std::chrono::duration<double>(SteadyClock::now() - start_).count();
  }

  SteadyClock::time_point start_ = SteadyClock::now();
  Source& source_;
  const RenderOptions& options_;
  Schedule schedule_;
  ChunkPlan plan_;
  std::int64_t firstChunk_;
  std::int64_t endChunk_;
  std::unique_ptr<ChunkedOutput> output_;
  SharedState state_;
  std::shared_ptr<void> ending_;   ///< the workers, while the parts are joined
  std::optional<Sidecar> sidecar_; ///< where there are captions
  std::string said_;               ///< of the output's notice
};

} // namespace

RenderResult renderChunks(Source& source, const RenderOptions& options) {
  return ChunkedRender(source, options).render();
}

RenderResult joinSegments(Source& source, const RenderOptions& options) {
  return ChunkedRender(source, options).joinOnly();
}

RenderOptions optionsOfSegments(const RenderOptions& options) {
  const fs::path folder = Parts::folderFor(options.out);
  const std::optional<Manifest> stored = Manifest::read(Parts::manifestFor(options.out));
  if (!stored) {
    throw Error(ExitCode::BadInput,
                fmt::format("there is no {} with parts to join: render the segments first, with "
                            "the same -o",
                            quoted(folder)));
  }
  RenderOptions merged = parseRenderOptions(stored->values(kOptions));
  const auto put = [](auto& to, const auto& given) {
    if (given) to = given;
  };
  put(merged.size, options.size);
  put(merged.fps, options.fps);
  put(merged.duration, options.duration);
  put(merged.from, options.from);
  put(merged.to, options.to);
  put(merged.dtLog, options.dtLog);
  put(merged.input, options.input);
  put(merged.seed, options.seed);
  put(merged.scale, options.scale);
  put(merged.quality, options.quality);
  merged.out = options.out;
  merged.hashFile = options.hashFile;
  merged.progress = options.progress;
  return merged;
}

} // namespace offstage
