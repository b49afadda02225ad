#include "render/job/bundle.h"

#include "render/job/bundle_page.h"
#include "render/job/frame_maker.h"
#include "render/job/interrupt.h"
#include "render/job/poster.h"
#include "render/job/rehearsal.h"
#include "render/job/render_job.h"
#include "render/job/scene_source.h"
#include "render/job/schedule.h"
#include "render/output/atomic_file.h"
#include "render/output/captions.h"
#include "render/output/file_error.h"
#include "render/output/staged_folder.h"
#include "render/output/text_output.h"
#include "src/scene/trace.h"
#include "src/sim/error.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace offstage {
namespace {

class BundleMaker {
public:
  BundleMaker(const Scene& scene, const RenderOptions& options)
      : scene_(scene), options_(options), name_(scene.file.stem().native()), folder_(options.out) {}

  std::vector<std::string> make() {
    const Viewport viewport = options_.viewport(scene_.size[0], scene_.size[1], scene_.scale);
    if (scene_.background.alpha < 1.0)
      throw Error(ExitCode::BadInput,
                  fmt::format("{}: a bundle's videos have no transparency: give [frame] an opaque background",
                              scene_.file.string()));
    if (options_.strict) rehearseAll(viewport);
    contents_.title = scene_.title;
    contents_.mp4 = add(".mp4");
    contents_.webm = add(".webm");
    contents_.poster = add(".jpg");
    SceneSource first(scene_, viewport);
    first.watch(scene_, warnings_);
    const Schedule schedule = scheduleOf(first, options_);
    const Picture picture = pictureOf(first);
    contents_.width = picture.width;
    contents_.height = picture.height;
    const VideoTracks tracks = first.tracks(schedule.origin(), schedule.origin() + schedule.seconds());
    contents_.captions = tracks.captions;
    contents_.chapters = tracks.chapters;

    Poster(folder_.temporary() / contents_.poster)
        .write(first, options_, scene_.timeline.poster, viewport.scale);
    // The GIF before the videos: each writes NAME.vtt, and the whole video's is the one that stays.
    renderTo(add(".gif"), gifOptions(viewport, schedule));
    renderTo(contents_.mp4, options_);
    renderTo(contents_.webm, options_);
    if (first.hasCaptions()) add(".vtt"); // which the renders have written
    if (!tracks.chapters.empty()) write(add(".chapters.vtt"), webVtt(tracks.chapters));
    if (!scene_.replay) trace(add(".csv"));
    write("index.html", bundlePage(contents_));
    folder_.commit();
    std::vector<std::string> files = contents_.files;
    files.emplace_back("index.html");
    return files;
  }

private:
  /// The trace has every frame, whatever part the videos show.
  void rehearseAll(const Viewport& viewport) const {
    WarningLog strict(WarningLog::Mode::Strict);
    SceneSource source(scene_, viewport);
    source.watch(scene_, strict);
    rehearse(source, scene_.clock.steps());
  }

  std::string add(const std::string& ending) {
    contents_.files.push_back(name_ + ending);
    return contents_.files.back();
  }

  void write(const std::string& name, const std::string& text) const {
    AtomicFile file(folder_.temporary() / name);
    file.write(text);
    file.commit();
  }

  void renderTo(const std::string& name, RenderOptions options) {
    options.out = folder_.temporary() / name;
    options.resume = false; // the folder goes with everything in it when one of its files fails
    SceneSource source(scene_, options.viewport(scene_.size[0], scene_.size[1], scene_.scale));
    source.watch(scene_, warnings_);
    render(source, options);
  }

  /// The video's beginning, small enough for a slide.
  [[nodiscard]] RenderOptions gifOptions(const Viewport& viewport, const Schedule& schedule) const {
    RenderOptions options = options_;
    options.quality.reset(); // a GIF has only one
    if (viewport.width > kBundleGifWidth) {
      const double height = static_cast<double>(viewport.height) * kBundleGifWidth / viewport.width;
      options.size = {kBundleGifWidth, std::max(static_cast<int>(std::lround(height)), 1)};
    }
    if (schedule.seconds() > kBundleGifSeconds) options.to = schedule.origin() + kBundleGifSeconds;
    return options;
  }

  void trace(const std::string& name) {
    TextOutput out(folder_.temporary() / name);
    TraceWriter writer(out.stream(), TraceFormat::Csv, scene_.world.groups);
    World world(scene_.world);
    WatchedRun run(world, WarningText(scene_), warnings_);
    writer.write(world);
    while (world.frame() < scene_.clock.steps()) {
      throwIfInterrupted();
      run.step(world, scene_.clock.tick(world.frame() + 1));
      writer.write(world);
    }
    out.commit();
  }

  const Scene& scene_;
  const RenderOptions& options_;
  std::string name_;
  WarningLog warnings_;
  StagedFolder folder_;
  BundleContents contents_;
};

} // namespace

std::vector<std::string> makeBundle(const Scene& scene, const RenderOptions& options) {
  if (options.out.empty()) throw Error(ExitCode::BadInput, "give -o DIR, the folder to make");
  return BundleMaker(scene, options).make();
}

} // namespace offstage
