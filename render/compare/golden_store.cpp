#include "render/compare/golden_store.h"

#include "render/draw/image.h"
#include "render/output/atomic_file.h"
#include "src/scene/quote.h"
#include "src/scene/tolerance_file.h"
#include "src/sim/error.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace offstage {
namespace {

/// The order of a report: what is worst for a reader comes first.
double severityOf(GoldenVerdict verdict) {
  switch (verdict) {
  case GoldenVerdict::Same:
    return 0.0;
  case GoldenVerdict::Obsolete:
    return 1.0;
  case GoldenVerdict::Missing:
    return 2.0;
  case GoldenVerdict::PixelsChanged:
    return 3.0;
  case GoldenVerdict::SizeChanged:
    return 4.0;
  case GoldenVerdict::PhysicsChanged:
    break;
  }
  return 5.0;
}

Frame loadFrame(const std::filesystem::path& file) {
  Image image = loadImage(file);
  Frame frame;
  frame.width = image.width;
  frame.height = image.height;
  frame.rgba = std::move(image.rgba);
  return frame;
}

/// What changed in the motion: where it began, and in which body by how much.
void tellPhysics(const GoldenPicture& picture, const std::optional<StatesDifference>& run,
                 const std::vector<std::string>& bodyNames, ReportCase& report) {
  if (!run) {
    report.lines.push_back("there are no recorded states to say where the change began");
    return;
  }
  if (!run->firstFrame) {
    report.lines.push_back(fmt::format("the recorded states up to frame {} are those of this run; the golden "
                                       "is older than they are",
                                       picture.number));
    return;
  }
  report.lines.push_back(fmt::format("first frame that differs: {}", *run->firstFrame));
  report.numbers.push_back({"first_differing_frame", "", *run->firstFrame});
  const TraceComparison& comparison = run->comparison;
  if (comparison.firstPresence &&
      (!comparison.first || comparison.firstPresence->frame <= comparison.first->frame)) {
    const TracePresence& presence = *comparison.firstPresence;
    report.lines.push_back(fmt::format("frame {} ({:.6g} s): body {} {}", presence.frame, presence.time,
                                       presence.body,
                                       presence.inExpected ? "is gone" : "was not there when recorded"));
  }
  if (!comparison.first) return;
  const TraceDeviation& first = *comparison.first;
  std::string line = describe(first);
  const auto id = static_cast<std::size_t>(first.body);
  if (id < bodyNames.size() && !bodyNames[id].empty())
    line += fmt::format("; body {} is {}", first.body, quotedText(bodyNames[id]));
  report.lines.push_back(line);
  report.numbers.push_back({"state_frame", "", first.frame});
  report.numbers.push_back({"state_body", "", first.body});
  report.numbers.push_back({"state_quantity", "", std::string(name(first.quantity))});
  report.numbers.push_back({"state_expected", "", first.expected, std::string(unit(first.quantity))});
  report.numbers.push_back({"state_actual", "", first.actual, std::string(unit(first.quantity))});
  report.numbers.push_back({"state_error", "", first.error, std::string(unit(first.quantity))});
}

/// `entry`: null without a line in the lock, and then nothing is known of the physics.
GoldenVerdict judge(const GoldenPicture& picture, const Comparison& comparison, const GoldenEntry* entry) {
  if (entry == nullptr) return GoldenVerdict::Missing;
  if (comparison.kind == Comparison::Kind::SizeDiffers) return GoldenVerdict::SizeChanged;
  if (entry->state != picture.state) return GoldenVerdict::PhysicsChanged;
  return comparison.same() ? GoldenVerdict::Same : GoldenVerdict::PixelsChanged;
}

/// Where another machine may be the reason, both are told.
void tellMachines(const GoldenMachine& recorded, const GoldenMachine& now, ReportCase& report) {
  const auto text = [](const GoldenMachine& machine) {
    return fmt::format("{}, Mesa {}, {}, Offstage {}", machine.renderer, machine.mesa, machine.processor,
                       machine.version);
  };
  if (text(recorded) == text(now)) return;
  report.lines.push_back("recorded with " + text(recorded));
  report.lines.push_back("drawn with " + text(now));
}

} // namespace

std::string_view name(GoldenVerdict verdict) {
  switch (verdict) {
  case GoldenVerdict::Same:
    return "same";
  case GoldenVerdict::PixelsChanged:
    return "pixels changed, physics did not";
  case GoldenVerdict::PhysicsChanged:
    return "physics changed";
  case GoldenVerdict::SizeChanged:
    return "size changed";
  case GoldenVerdict::Missing:
    return "golden missing";
  case GoldenVerdict::Obsolete:
    break;
  }
  return "golden obsolete";
}

GoldenStore::GoldenStore(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder_, error))
    throw Error(ExitCode::BadInput, fmt::format("{}: there is no such folder", printable(folder_.string())));
  lock_ = GoldenLock::load(lockFile());
  const std::filesystem::path tolerance = folder_ / "tolerance.toml";
  if (std::filesystem::exists(tolerance, error)) tolerance_ = loadTolerance(tolerance);
}

std::filesystem::path GoldenStore::pictureFile(const std::string& name) const {
  return folder_ / (name + ".png");
}

std::filesystem::path GoldenStore::statesFile(const std::string& sceneName) const {
  return folder_ / (sceneName + ".states.csv");
}

std::string GoldenStore::toleranceText() const {
  return offstage::toleranceText(tolerance_.value_or(Tolerance{}));
}

std::optional<GoldenStates> GoldenStore::states(const std::string& sceneName) const {
  std::error_code error;
  if (!std::filesystem::exists(statesFile(sceneName), error)) return std::nullopt;
  return readGoldenStates(statesFile(sceneName));
}

GoldenFinding GoldenStore::verify(const GoldenPicture& picture, const Tolerance* tolerance,
                                  const std::optional<StatesDifference>& run,
                                  const std::vector<std::string>& bodyNames) const {
  GoldenFinding finding;
  const GoldenEntry* entry = lock_.find(picture.name);
  const std::filesystem::path file = pictureFile(picture.name);
  ReportPictures pictures;
  const Tolerance inForce = tolerance != nullptr ? *tolerance : tolerance_.value_or(Tolerance{});
  if (!hasPicture(picture.name)) {
    finding.verdict = GoldenVerdict::Missing;
    finding.report.name = picture.name;
    finding.report.lines.push_back(fmt::format("there is no {}", printable(file.string())));
    pictures.actual = reportPicture(picture.frame);
  } else {
    const Frame expected = loadFrame(file);
    Comparer comparer(inForce, Metrics::Fast, 1);
    const Comparison comparison = comparer.compare(expected, picture.frame);
    finding.report = reportCase(picture.name, comparison);
    finding.verdict = judge(picture, comparison, entry);
    finding.pictureHolds = comparison.same();
    if (entry == nullptr) {
      finding.report.lines.push_back(fmt::format("{} has no line for it", printable(lockFile().string())));
    } else if (entry->state != picture.state) {
      tellPhysics(picture, run, bodyNames, finding.report);
    } else if (finding.verdict == GoldenVerdict::PixelsChanged) {
      tellMachines(entry->machine, picture.machine, finding.report);
    }
    if (finding.verdict != GoldenVerdict::Same) {
      const Frame difference = comparer.difference(expected, picture.frame);
      finding.strip = makeStrip(expected, difference, picture.frame);
      pictures.expected = reportPicture(expected);
      pictures.actual = reportPicture(picture.frame);
      pictures.difference = reportPicture(difference);
    }
  }
  finding.report.verdict = name(finding.verdict);
  finding.report.tolerance = offstage::toleranceText(inForce);
  finding.report.passed = finding.verdict == GoldenVerdict::Same;
  // Among goldens of one verdict, those whose pictures differ more come first.
  finding.report.severity = severityOf(finding.verdict) + std::min(finding.report.severity / 4.0, 0.9);
  if (!finding.report.passed) finding.report.pictures.push_back(std::move(pictures));
  return finding;
}

std::vector<std::string> GoldenStore::obsolete(const std::set<std::string>& wanted) const {
  std::set<std::string> found;
  for (const auto& [name, entry] : lock_.entries()) found.insert(name);
  for (const auto& file : std::filesystem::directory_iterator(folder_)) {
    const std::string stem = file.path().stem().string();
    if (file.path().extension() == ".png" && sceneOfGolden(stem) != stem) found.insert(stem);
  }
  std::vector<std::string> names;
  std::set_difference(found.begin(), found.end(), wanted.begin(), wanted.end(), std::back_inserter(names));
  return names;
}

GoldenFinding GoldenStore::findObsolete(const std::string& golden) const {
  GoldenFinding finding;
  finding.verdict = GoldenVerdict::Obsolete;
  finding.report.name = golden;
  finding.report.verdict = name(finding.verdict);
  finding.report.passed = false;
  finding.report.severity = severityOf(finding.verdict);
  finding.report.lines.push_back("no scene has this moment in its [golden]");
  if (hasPicture(golden)) {
    ReportPictures pictures;
    pictures.expected = reportPicture(loadFrame(pictureFile(golden)));
    finding.report.pictures.push_back(std::move(pictures));
  }
  return finding;
}

bool GoldenStore::hasPicture(const std::string& name) const {
  std::error_code error;
  return std::filesystem::exists(pictureFile(name), error);
}

void GoldenStore::put(const std::string& name, const std::vector<std::uint8_t>& png,
                      const GoldenEntry& entry) {
  AtomicFile file(pictureFile(name));
  file.write(png.data(), png.size());
  file.commit();
  lock_.set(name, entry);
}

void GoldenStore::putStates(const std::string& sceneName, const std::string& text) {
  AtomicFile file(statesFile(sceneName));
  file.write(text);
  file.commit();
}

void GoldenStore::remove(const std::string& name) {
  std::error_code error;
  std::filesystem::remove(pictureFile(name), error);
  lock_.erase(name);
  const std::string scene = sceneOfGolden(name);
  const auto& entries = lock_.entries();
  const bool another = std::any_of(entries.begin(), entries.end(),
                                   [&](const auto& entry) { return sceneOfGolden(entry.first) == scene; });
  if (!another) std::filesystem::remove(statesFile(scene), error);
}

std::string sceneOfGolden(const std::string& name) {
  const std::size_t mark = name.rfind('@');
  return mark == std::string::npos || !name.ends_with('s') ? name : name.substr(0, mark);
}

GoldenEntry entryOf(const GoldenPicture& picture) {
  return {picture.state, picture.frame.hash(), picture.machine};
}

} // namespace offstage
