#include "render/job/render_job.h"

#include "render/job/chunked_render.h"
#include "render/job/console.h"
#include "render/job/frame_maker.h"
#include "render/job/interrupt.h"
#include "render/job/left_out.h"
#include "render/job/notice.h"
#include "render/job/output_places.h"
#include "render/job/parts.h"
#include "render/job/sidecar.h"
#include "render/output/atomic_file.h"
#include "render/output/file_error.h"
#include "render/output/output_kind.h"
#include "render/output/sink.h"
#include "src/sim/error.h"

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace offstage {
namespace {

/// Frames front to back in this process: a raw output, or none but the hashes.
RenderResult renderStream(Source& source, const RenderOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  if (options.segment)
    throw Error(ExitCode::BadInput, "--segment: only videos and pictures are made in segments");
  const Schedule schedule = scheduleOf(source, options);

  // Everything that can be refused is refused here, before a frame costs time.
  std::unique_ptr<Sink> sink;
  if (!options.out.empty()) {
    const Picture picture = pictureOf(source);
    sink = makeSink(options.out, {picture.width, picture.height, picture.background.a != 255, schedule.fps(),
                                  source.title(), options.quality});
    sink->setSignalWatch(throwIfInterrupted);
    removeAbandoned(options.out);
    // Whoever reads a pipe knows that frames are all that comes.
    if (outputKind(options.out) == OutputKind::RawFile)
      printNotice(leftOutNotice(options.out,
                                source.tracks(schedule.origin(), schedule.origin() + schedule.seconds())));
  }
  std::optional<AtomicFile> hashes;
  if (!options.hashFile.empty()) {
    removeAbandoned(options.hashFile);
    hashes.emplace(options.hashFile);
  }
  FrameMaker frames(source, schedule);

  Progress progress(options.progress, schedule.frames(), schedule.seconds());
  const auto bytes = [&] { return sink ? sink->bytesWritten() : 0; };
  for (std::int64_t index = 0; index < schedule.frames(); ++index) {
    throwIfInterrupted();
    const Frame& frame = frames.make(index);
    if (hashes) hashes->write(frames.hashLine());
    if (sink) sink->write(frame, schedule.timing(index));
    progress.update(index + 1, bytes());
  }
  throwIfInterrupted();
  if (sink) sink->finish();
  if (hashes) hashes->commit();
  progress.finish(bytes());

  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return {schedule.frames(), schedule.seconds(), elapsed.count(), bytes()};
}

/// Where the options' outputs go.
std::array<OutputPlace, 3> placesOf(const RenderOptions& options) {
  const bool isPattern =
      !options.out.empty() && options.out != "-" && outputKind(options.out) == OutputKind::PngSequence;
  return {{{"-o", options.out, isPattern}, {"--hash", options.hashFile}, {"--poster", options.poster}}};
}

} // namespace

RenderResult render(Source& source, const RenderOptions& options) {
  if (options.out.empty() || isStream(outputKind(options.out))) return renderStream(source, options);
  return renderChunks(source, options);
}

void requireOutput(const RenderOptions& options) {
  if (options.out.empty() && options.hashFile.empty() && options.poster.empty())
    throw Error(ExitCode::BadInput, "nothing to make: give -o OUT (or --hash FILE, or --poster FILE)");
  if (options.hashFile == "-")
    throw Error(ExitCode::BadInput, "--hash writes to a file, not to standard output");
  const auto [out, hash, poster] = placesOf(options);
  requireApart(out, hash.option, hash.out);
  requireApart(out, poster.option, poster.out);
  requireApart(hash, poster.option, poster.out);
  if (options.out.empty() || isStream(outputKind(options.out))) return;
  // What waits there goes with the folder when all is made.
  const std::filesystem::path parts = Parts::folderFor(options.out);
  for (const OutputPlace& output : {hash, poster}) {
    requireApart(output, "the folder of the parts", parts);
    if (!output.out.empty())
      requireApart({output.option, placeOf(output.out).parent_path()}, "a folder that is removed", parts);
  }
}

void requireApart(const RenderOptions& options, const Scene& scene) {
  const bool captions = !scene.timeline.captions.empty() || !scene.timeline.eventCaptions.empty();
  for (const OutputPlace& output : placesOf(options)) {
    if (options.dtLog) requireApart(output, "--dt", *options.dtLog);
    if (options.input) requireApart(output, "--input", *options.input);
    requireApart(output, scene);
    if (!captions || options.out.empty()) continue;
    if (const auto sidecar = Sidecar::nameFor(options.out))
      requireApart(output, "the captions' file", *sidecar);
  }
}

void printSummary(const RenderResult& result, const RenderOptions& options) {
  const std::filesystem::path& made = options.out.empty() ? options.hashFile : options.out;
  std::string text = made.string();
  if (options.segment)
    text += fmt::format(", segment {} of {}", options.segment->number, options.segment->count);
  text += fmt::format(": {} frame{}, {:.3f} s, in {:.2f} s ({:.1f}x real time)", result.frames,
                      result.frames == 1 ? "" : "s", result.seconds, result.elapsed,
                      result.elapsed > 0.0 ? result.seconds / result.elapsed : 0.0);
  if (!options.out.empty()) text += fmt::format(", {} KiB", (result.bytes + 1023) / 1024);
  say(options.out == "-" ? stderr : stdout, text + "\n");
}

} // namespace offstage
