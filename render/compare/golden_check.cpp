#include "render/compare/golden_check.h"

#include "render/compare/compare_images.h"
#include "render/compare/report.h"
#include "render/draw/image.h"
#include "render/output/atomic_file.h"
#include "render/output/png.h"
#include "src/scene/quote.h"
#include "src/sim/error.h"

#include <cstdlib>
#include <sstream>
#include <utility>

#include <fmt/format.h>

namespace offstage {
namespace {

std::vector<std::filesystem::path>& rewritten() {
  static std::vector<std::filesystem::path> files;
  return files;
}

std::filesystem::path& chosenFolder() {
  static std::filesystem::path folder;
  return folder;
}

std::filesystem::path& chosenOutFolder() {
  static std::filesystem::path folder;
  return folder;
}

std::filesystem::path folderOf(const std::filesystem::path& chosen, const char* variable,
                               const char* otherwise) {
  if (!chosen.empty()) return chosen;
  const char* named = std::getenv(variable);
  return named != nullptr && *named != '\0' ? named : otherwise;
}

bool updating() {
  const char* value = std::getenv("OFFSTAGE_UPDATE_GOLDENS");
  return value != nullptr && std::string_view(value) == "1";
}

bool opaque(const Frame& frame) {
  for (std::size_t i = 3; i < frame.rgba.size(); i += 4)
    if (frame.rgba[i] != 255) return false;
  return true;
}

void writeFrame(const std::filesystem::path& path, const Frame& frame) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  const std::vector<std::uint8_t> png = encodePng(frame, !opaque(frame));
  AtomicFile file(path);
  file.write(png.data(), png.size());
  file.commit();
}

/// The comparison as `offstage diff` prints it.
std::string textOf(const Comparison& comparison, const Tolerance& tolerance) {
  Report report;
  const ReportCase one = reportCase("frame", comparison);
  report.verdict = one.verdict;
  report.tolerance = toleranceText(tolerance);
  report.cases.push_back(one);
  std::ostringstream out;
  writeText(out, report);
  return out.str();
}

FrameCheck rewrite(const std::filesystem::path& file, const Frame& actual) {
  writeFrame(file, actual);
  rewritten().push_back(file);
  return {true, fmt::format("golden rewritten: {}\n", file.string())};
}

FrameCheck holdTo(const std::filesystem::path& file, const Frame& actual, const std::string& name,
                  const Tolerance& tolerance) {
  const std::filesystem::path drawn = goldenOutFolder() / (name + ".actual.png");
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    if (updating()) return rewrite(file, actual);
    writeFrame(drawn, actual);
    return {false, fmt::format("golden missing: {}\n  drawn: {}\n  OFFSTAGE_UPDATE_GOLDENS=1 records it\n",
                               file.string(), drawn.string())};
  }
  Image image = loadImage(file);
  Frame expected;
  expected.width = image.width;
  expected.height = image.height;
  expected.rgba = std::move(image.rgba);
  Comparer comparer(tolerance, Metrics::Fast, 1);
  const Comparison comparison = comparer.compare(expected, actual);
  if (comparison.same()) return {true, textOf(comparison, tolerance)};
  if (updating()) return rewrite(file, actual);

  const std::filesystem::path strip = goldenOutFolder() / (name + ".strip.png");
  writeFrame(drawn, actual);
  writeFrame(strip, makeStrip(expected, comparer.difference(expected, actual), actual));
  return {false, fmt::format("{}  golden: {}\n  drawn:  {}\n  strip:  {}\n  OFFSTAGE_UPDATE_GOLDENS=1 takes "
                             "what was drawn\n",
                             textOf(comparison, tolerance), file.string(), drawn.string(), strip.string())};
}

} // namespace

FrameCheck checkSameFrame(const Frame& expected, const Frame& actual, const Tolerance& tolerance) {
  const Comparison comparison = compareImages(expected, actual, tolerance);
  return {comparison.same(), textOf(comparison, tolerance)};
}

FrameCheck checkGolden(const Frame& actual, const std::string& name, const Tolerance& tolerance) {
  // The name becomes a file's; it must not lead elsewhere.
  if (name.empty() || name.find('/') != std::string::npos || name.find('\0') != std::string::npos)
    return {false, fmt::format("{} cannot be a golden's name\n", quotedText(name))};
  try {
    return holdTo(goldenFolder() / (name + ".png"), actual, name, tolerance);
  } catch (const Error& problem) {
    return {false, fmt::format("{}\n", problem.what())};
  }
}

const std::vector<std::filesystem::path>& rewrittenGoldens() {
  return rewritten();
}

std::filesystem::path goldenFolder() {
  return folderOf(chosenFolder(), "OFFSTAGE_GOLDENS", "goldens");
}

void setGoldenFolder(const std::filesystem::path& folder) {
  chosenFolder() = folder;
}

std::filesystem::path goldenOutFolder() {
  return folderOf(chosenOutFolder(), "OFFSTAGE_GOLDEN_OUT", "out/golden");
}

void setGoldenOutFolder(const std::filesystem::path& folder) {
  chosenOutFolder() = folder;
}

} // namespace offstage
