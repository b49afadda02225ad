#include "render/job/golden_job.h"

#include "render/compare/golden_output.h"
#include "render/compare/golden_store.h"
#include "render/compare/ignore.h"
#include "render/compare/shell_word.h"
#include "render/job/interrupt.h"
#include "render/job/rehearsal.h"
#include "render/job/scene_source.h"
#include "render/job/still.h"
#include "render/output/png.h"
#include "render/raster/canvas.h"
#include "src/scene/quote.h"
#include "src/scene/scene.h"
#include "src/sim/error.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>

namespace offstage {
namespace {

std::vector<Scene> scenesWithGoldens(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::filesystem::path& file = entry.path();
    if (file.extension() == ".toml" && file.filename() != "tolerance.toml") files.push_back(file);
  }
  if (error)
    throw Error(ExitCode::BadInput, fmt::format("{}: {}", printable(folder.string()), error.message()));
  std::sort(files.begin(), files.end());
  std::vector<Scene> scenes;
  for (const std::filesystem::path& file : files) {
    Scene scene = loadScene(file);
    if (scene.golden) scenes.push_back(std::move(scene));
  }
  return scenes;
}

std::vector<Scene> requireScenes(const std::filesystem::path& folder) {
  std::vector<Scene> scenes = scenesWithGoldens(folder);
  if (scenes.empty())
    throw Error(ExitCode::BadInput,
                fmt::format("no scene in {} has a [golden] with the moments to keep; --scenes names another "
                            "folder",
                            printable(folder.string())));
  return scenes;
}

std::vector<std::string> groupsOf(const Scene& scene) {
  return scene.replay ? scene.replay->trace.groups : scene.world.groups;
}

/// With Strict: throws what there is to warn of in a scene's run up to its last golden.
void rehearseGoldens(const std::vector<Scene>& scenes, WarningLog::Mode mode) {
  if (mode != WarningLog::Mode::Strict) return;
  for (const Scene& scene : scenes) {
    WarningLog strict(mode);
    SceneSource source(scene, Viewport::scaled(scene.size[0], scene.size[1], scene.scale));
    source.watch(scene, strict);
    for (const double at : scene.golden->at) {
      const Moment moment = shotAt(source, at).moment;
      rehearse(source, moment.frame + (moment.fraction > 0.0 ? 1 : 0));
    }
  }
}

/// One scene's run through all its golden moments.
class GoldenRun {
public:
  GoldenRun(const Scene& scene, const GoldenStore& store)
      : scene_(scene),
        name_(scene.file.stem().string()),
        source_(scene, Viewport::scaled(scene.size[0], scene.size[1], scene.scale)),
        recorder_(groupsOf(scene), framesOf(scene, source_)),
        recorded_(store.states(name_)) {
    source_.watch(scene, warnings_);
    if (recorded_) watch_.emplace(*recorded_);
    source_.draw(picture_);
    static_cast<void>(
        ignoredPixels(scene.golden->tolerance, picture_.width, picture_.height)); // are they there?
    canvas_ = std::make_unique<Canvas>(picture_.width, picture_.height);
    const Canvas::Info info = canvas_->info();
    machine_ = thisMachine(info.renderer, info.version);
    note();
  }

  /// Calls `each` with every golden moment, in order of time.
  void drawEach(const std::function<void(const GoldenPicture&)>& each) {
    for (const double at : scene_.golden->at) {
      const Shot shot = shotAt(source_, at);
      while (source_.frame() < shot.moment.frame) {
        throwIfInterrupted();
        source_.step();
        note();
      }
      source_.show(shot);
      if (source_.frame() > noted_)
        note(); // a moment between two frames lets the source stand at the later one
      GoldenPicture golden;
      golden.name = goldenName(name_, at);
      golden.sceneName = name_;
      source_.draw(picture_);
      canvas_->draw(picture_, golden.frame);
      golden.alpha = picture_.background.a != 255;
      golden.number = shot.moment.frame;
      golden.time = source_.clock().time(shot.moment.frame);
      golden.state = source_.shownStateHash();
      golden.machine = machine_;
      each(golden);
    }
  }

  /// This run against the recorded one, as far as it has got.
  [[nodiscard]] std::optional<StatesDifference> difference() const {
    if (!watch_) return std::nullopt;
    return watch_->difference();
  }
  [[nodiscard]] std::string states() const { return recorder_.text(); }
  [[nodiscard]] const std::string& name() const { return name_; }

private:
  static std::vector<std::int64_t> framesOf(const Scene& scene, const SceneSource& source) {
    std::vector<std::int64_t> frames;
    for (const double at : scene.golden->at) frames.push_back(shotAt(source, at).moment.frame);
    return frames;
  }

  void note() {
    noted_ = source_.frame();
    recorder_.add(source_.frame(), source_.time(), source_.stateHash(), source_.bodies());
    if (watch_) watch_->add(source_.frame(), source_.time(), source_.stateHash(), source_.bodies());
  }

  const Scene& scene_;
  std::string name_;
  WarningLog warnings_;
  SceneSource source_;
  GoldenRecorder recorder_;
  std::optional<GoldenStates> recorded_;
  std::optional<StatesWatch> watch_;
  std::int64_t noted_ = -1; ///< the last frame whose state was recorded
  Picture picture_;
  std::unique_ptr<Canvas> canvas_;
  GoldenMachine machine_;
};

std::string acceptCommand(const GoldenFolders& folders, const std::string& name) {
  const std::string out =
      folders.out == kGoldenOut ? "" : fmt::format("--out {} ", shellWord(folders.out.string()));
  return fmt::format("offstage golden accept {} {}{}", shellWord(folders.goldens.string()), out,
                     shellWord(name));
}

const Tolerance* toleranceOf(const Scene& scene) {
  return scene.golden->hasTolerance ? &scene.golden->tolerance : nullptr;
}

/// The tolerance that all drawn goldens were held to, in words; where scenes have different ones, the
/// folder's, or that each has its own.
std::string toleranceOfAll(const Report& report, const std::string& ofFolder) {
  std::set<std::string> own;
  for (const ReportCase& one : report.cases)
    if (!one.tolerance.empty()) own.insert(one.tolerance); // obsolete ones are held to nothing
  if (own.empty() || own.contains(ofFolder)) return ofFolder;
  return own.size() == 1 ? *own.begin() : "each scene's own";
}

/// Says how many goldens have which verdict; of a single one, its name and verdict.
void summarize(Report& report) {
  std::map<std::string, std::size_t> counts;
  for (const ReportCase& one : report.cases) {
    ++counts[one.verdict];
    report.passed = report.passed && one.passed;
  }
  const std::size_t same = counts[std::string(name(GoldenVerdict::Same))];
  report.verdict = report.passed ? "same"
                                 : fmt::format("{} of {} goldens are not the same",
                                               report.cases.size() - same, report.cases.size());
  if (report.cases.size() == 1) {
    report.lines.push_back(report.cases.front().name + ": " + report.cases.front().verdict);
    return;
  }
  for (const GoldenVerdict verdict :
       {GoldenVerdict::PhysicsChanged, GoldenVerdict::SizeChanged, GoldenVerdict::PixelsChanged,
        GoldenVerdict::Missing, GoldenVerdict::Obsolete, GoldenVerdict::Same}) {
    const std::string words(name(verdict));
    if (counts[words] > 0) report.lines.push_back(fmt::format("{} {}", counts[words], words));
  }
}

} // namespace

Report verifyGoldens(const GoldenFolders& folders, WarningLog::Mode mode) {
  const GoldenStore store(folders.goldens);
  const std::vector<Scene> scenes = scenesWithGoldens(folders.scenes);
  if (scenes.empty() && store.obsolete({}).empty()) static_cast<void>(requireScenes(folders.scenes));
  rehearseGoldens(scenes, mode);
  GoldenOutput out(folders.out, folders.goldens);
  Report report;
  report.title = "offstage golden verify " + folders.goldens.string();
  report.suite = "offstage.golden";

  std::set<std::string> wanted;
  for (const Scene& scene : scenes) {
    GoldenRun run(scene, store);
    bool allSame = true;
    run.drawEach([&](const GoldenPicture& picture) {
      const auto start = std::chrono::steady_clock::now();
      wanted.insert(picture.name);
      GoldenFinding finding = store.verify(picture, toleranceOf(scene), run.difference(), scene.bodyNames);
      if (finding.verdict != GoldenVerdict::Same) {
        out.keep(picture, finding);
        finding.report.acceptCommand = acceptCommand(folders, picture.name);
        allSame = false;
      }
      finding.report.seconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      report.cases.push_back(std::move(finding.report));
    });
    if (!allSame) out.keepStates(run.name(), run.states());
  }
  for (const std::string& name : store.obsolete(wanted)) {
    GoldenFinding finding = store.findObsolete(name);
    finding.report.acceptCommand = acceptCommand(folders, name);
    out.keepObsolete(name);
    report.cases.push_back(std::move(finding.report));
  }
  report.tolerance = toleranceOfAll(report, store.toleranceText());
  summarize(report);
  out.finish(report);
  return report;
}

GoldenRecording recordGoldens(const GoldenFolders& folders, WarningLog::Mode mode) {
  const std::vector<Scene> scenes = requireScenes(folders.scenes);
  rehearseGoldens(scenes, mode);
  std::error_code failed; // the store says what is wrong with the folder
  std::filesystem::create_directories(folders.goldens, failed);
  GoldenStore store(folders.goldens);
  GoldenRecording recording;
  for (const Scene& scene : scenes) {
    GoldenRun run(scene, store);
    std::size_t written = 0;
    std::size_t kept = 0;
    run.drawEach([&](const GoldenPicture& picture) {
      const GoldenFinding finding = store.verify(picture, toleranceOf(scene), std::nullopt, scene.bodyNames);
      if (finding.verdict == GoldenVerdict::Same) {
        recording.unchanged.push_back(picture.name);
        ++kept;
      } else if (finding.verdict == GoldenVerdict::Missing &&
                 (finding.pictureHolds || !store.hasPicture(picture.name))) {
        // A picture that only lacked its line stays as it is.
        if (finding.pictureHolds) {
          store.lock().set(picture.name, entryOf(picture));
        } else {
          store.put(picture.name, encodePng(picture.frame, picture.alpha), entryOf(picture));
        }
        recording.recorded.push_back(picture.name);
        ++written;
      } else {
        recording.differing.push_back(picture.name);
        ++kept;
      }
    });
    // The states belong to the goldens that are there; only a run that they all come from may replace them.
    const bool allAreOfThisRun = recording.differing.empty();
    if (written > 0 && (kept == 0 || allAreOfThisRun)) store.putStates(run.name(), run.states());
  }
  store.saveLock();
  return recording;
}

} // namespace offstage
