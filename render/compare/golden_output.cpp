#include "render/compare/golden_output.h"

#include "render/draw/image.h"
#include "render/output/atomic_file.h"
#include "render/output/png.h"
#include "src/scene/nearest.h"
#include "src/scene/quote.h"
#include "src/scene/text_file.h"
#include "src/sim/error.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr std::size_t kLargestText = std::size_t{256} << 20U;
/// Which goldens were verified, and which of them are obsolete, a line each.
constexpr std::string_view kVerified = "verified.txt";
constexpr std::string_view kDrawn = "drawn.lock";

std::filesystem::path actualFile(const std::filesystem::path& folder, const std::string& name) {
  return folder / (name + ".actual.png");
}

std::string absoluteName(const std::filesystem::path& folder) {
  return std::filesystem::weakly_canonical(folder).string();
}

void writeFrame(const std::filesystem::path& path, const Frame& frame, bool alpha) {
  const std::vector<std::uint8_t> png = encodePng(frame, alpha);
  AtomicFile file(path);
  file.write(png.data(), png.size());
  file.commit();
}

bool isOurs(const std::string& name) {
  return name.ends_with(".actual.png") || name.ends_with(".strip.png") || name.ends_with(".states.csv") ||
         name == kVerified || name == kDrawn;
}

} // namespace

GoldenOutput::GoldenOutput(std::filesystem::path folder, const std::filesystem::path& goldens)
    : folder_(std::move(folder)), goldens_(absoluteName(goldens)) {
  if (absoluteName(folder_) == goldens_)
    throw Error(ExitCode::BadInput, "what a verification leaves cannot go into the folder of the goldens");
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (!std::filesystem::is_directory(folder_))
    throw Error(ExitCode::BadInput, fmt::format("{}: the folder cannot be made: {}",
                                                printable(folder_.string()), error.message()));
  requireReportFolder(reportFolder());
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (entry.is_regular_file() && isOurs(entry.path().filename().string())) old.push_back(entry.path());
  }
  for (const std::filesystem::path& file : old) std::filesystem::remove(file, error);
}

void GoldenOutput::keep(const GoldenPicture& picture, const GoldenFinding& finding) {
  writeFrame(actualFile(folder_, picture.name), picture.frame, picture.alpha);
  if (finding.strip) writeFrame(folder_ / (picture.name + ".strip.png"), *finding.strip, false);
  drawn_.set(picture.name, entryOf(picture));
}

void GoldenOutput::keepStates(const std::string& sceneName, const std::string& states) {
  AtomicFile file(folder_ / (sceneName + ".states.csv"));
  file.write(states);
  file.commit();
}

void GoldenOutput::keepObsolete(const std::string& name) {
  obsolete_.push_back(name);
}

void GoldenOutput::finish(const Report& report) const {
  drawn_.save(folder_ / kDrawn);
  AtomicFile verified(folder_ / kVerified);
  verified.write(goldens_ + "\n");
  for (const std::string& name : obsolete_) verified.write(name + "\n");
  verified.commit();
  writeHtml(reportFolder(), report);
}

std::vector<std::string> acceptGoldens(GoldenStore& store, const std::filesystem::path& folder,
                                       const std::vector<std::string>& names) {
  const std::filesystem::path verified = folder / kVerified;
  std::error_code error;
  if (!std::filesystem::exists(verified, error))
    throw Error(
        ExitCode::BadInput,
        fmt::format("there is nothing to accept in {}: verify first, and look at what it leaves there",
                    printable(folder.string())));
  std::istringstream lines(readTextFile(verified, kLargestText, "a list of goldens"));
  std::string of;
  std::getline(lines, of);
  if (of != absoluteName(store.folder()))
    throw Error(ExitCode::BadInput,
                fmt::format("what {} holds is of {}, not of {}: verify first", printable(folder.string()),
                            printable(of), printable(store.folder().string())));
  std::set<std::string> obsolete;
  for (std::string line; std::getline(lines, line);) obsolete.insert(line);
  const GoldenLock drawn = GoldenLock::load(folder / kDrawn);

  std::set<std::string> all = obsolete;
  for (const auto& [name, entry] : drawn.entries()) all.insert(name);
  std::set<std::string> chosen = names.empty() ? all : std::set<std::string>(names.begin(), names.end());
  const std::vector<std::string_view> known(all.begin(), all.end());
  for (const std::string& name : chosen) {
    if (all.contains(name)) continue;
    const std::string_view near = nearest(name, known);
    throw Error(ExitCode::BadInput,
                fmt::format("{} is not among what the last verification left{}", quotedText(name),
                            near.empty() ? "" : fmt::format("; did you mean {}?", quotedText(near))));
  }
  for (const std::string& name : chosen) {
    if (obsolete.contains(name)) {
      store.remove(name);
      continue;
    }
    Image image = loadImage(actualFile(folder, name));
    Frame frame;
    frame.width = image.width;
    frame.height = image.height;
    frame.rgba = std::move(image.rgba);
    const GoldenEntry& entry = *drawn.find(name);
    if (frame.hash() != entry.pixels)
      throw Error(ExitCode::BadInput, fmt::format("{} is not the picture that the last verification drew",
                                                  printable(actualFile(folder, name).string())));
    const std::string bytes = readTextFile(actualFile(folder, name), kLargestText, "a picture");
    store.put(name, {bytes.begin(), bytes.end()}, entry);
    const std::filesystem::path states = folder / (sceneOfGolden(name) + ".states.csv");
    if (std::filesystem::exists(states, error))
      store.putStates(sceneOfGolden(name), readTextFile(states, kLargestText, "a file of golden states"));
  }
  store.saveLock();
  return {chosen.begin(), chosen.end()};
}

} // namespace offstage
