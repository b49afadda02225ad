#include "src/scene/tolerance_file.h"

#include "src/scene/nearest.h"
#include "src/scene/quote.h"
#include "src/scene/table_reader.h"
#include "src/scene/text_file.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <fmt/format.h>

namespace offstage {
namespace {

constexpr std::size_t kLargestFile = 1UL << 20;
constexpr std::int64_t kMostPixels = std::numeric_limits<std::int32_t>::max();
/// Far beyond any picture.
constexpr std::int64_t kLargestCoordinate = 1000000;

constexpr std::array<std::string_view, 11> kKeys{
    "max_channel",  "max_pixels",          "max_ratio",    "max_cluster", "flip_max", "ssim_min",
    "max_forgiven", "ignore_antialiasing", "strict_alpha", "ignore",      "mask"};

void readBoolean(const TomlValue& value, const std::string& what, bool& to, ErrorList& errors) {
  if (const bool* given = std::get_if<bool>(&value.data))
    to = *given;
  else
    reportMismatch(value, what, "true or false", errors);
}

void readRegions(const TomlValue& value, const std::string& what, std::vector<IgnoredRegion>& to,
                 ErrorList& errors) {
  if (value.array() == nullptr)
    return reportMismatch(value, what, "an array of [x, y, width, height]", errors);
  for (const TomlValue& region : *value.array()) {
    const TomlValue::Array* sides = region.array();
    if (sides == nullptr || sides->size() != 4) {
      reportMismatch(region, "a region of " + what, "[x, y, width, height]", errors);
      continue;
    }
    std::array<int, 4> numbers{};
    bool good = true;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto number = readInteger((*sides)[i], fmt::format("value {} of a region of {}", i + 1, what),
                                      i < 2 ? -kLargestCoordinate : 0, kLargestCoordinate, errors);
      good = good && number;
      numbers.at(i) = static_cast<int>(number.value_or(0));
    }
    if (good) to.push_back({numbers[0], numbers[1], numbers[2], numbers[3]});
  }
}

void readMasks(const TomlValue& value, const std::string& what, const std::filesystem::path& folder,
               std::vector<std::filesystem::path>& to, ErrorList& errors) {
  const auto one = [&](const TomlValue& name) {
    const std::string* text = std::get_if<std::string>(&name.data);
    if (text == nullptr || text->empty())
      return reportMismatch(name, what, "a file or an array of files", errors);
    std::error_code error;
    const std::filesystem::path file = folder / *text;
    if (!std::filesystem::is_regular_file(file, error))
      return errors.add(
          name, fmt::format("{} names the file {}, which {}", what, quotedText(*text),
                            std::filesystem::exists(file, error) ? "is no regular file" : "does not exist"));
    to.push_back(file);
  };
  if (value.array() == nullptr) return one(value);
  for (const TomlValue& name : *value.array()) one(name);
}

} // namespace

std::span<const std::string_view> toleranceKeys() {
  return kKeys;
}

bool readToleranceEntry(const TomlEntry& entry, const std::filesystem::path& folder, Tolerance& tolerance,
                        ErrorList& errors) {
  const std::string what = "'" + entry.key + "'";
  const auto number = [&](std::optional<double>& to, double low, double high) {
    if (const auto given = readNumber(entry.value, what, Range::between(low, high), errors)) to = given;
    return true;
  };
  const auto pixels = [&](std::optional<std::int64_t>& to) {
    if (const auto given = readInteger(entry.value, what, 0, kMostPixels, errors)) to = given;
    return true;
  };
  if (entry.key == "max_channel") return number(tolerance.maxChannel, 0.0, 255.0);
  if (entry.key == "max_pixels") return pixels(tolerance.maxPixels);
  if (entry.key == "max_ratio") return number(tolerance.maxRatio, 0.0, 1.0);
  if (entry.key == "max_cluster") return pixels(tolerance.maxCluster);
  if (entry.key == "flip_max") return number(tolerance.flipMax, 0.0, 1.0);
  if (entry.key == "ssim_min") return number(tolerance.ssimMin, -1.0, 1.0);
  if (entry.key == "max_forgiven") return pixels(tolerance.maxForgiven);
  if (entry.key == "ignore_antialiasing")
    readBoolean(entry.value, what, tolerance.ignoreAntialiasing, errors);
  else if (entry.key == "strict_alpha")
    readBoolean(entry.value, what, tolerance.strictAlpha, errors);
  else if (entry.key == "ignore")
    readRegions(entry.value, what, tolerance.ignore, errors);
  else if (entry.key == "mask")
    readMasks(entry.value, what, folder, tolerance.masks, errors);
  else
    return false;
  return true;
}

Tolerance loadTolerance(const std::filesystem::path& file) {
  ErrorList errors(file.string());
  Diagnostic problem;
  const auto table = parseToml(readTextFile(file, kLargestFile, "a tolerance"), file.string(), problem);
  if (!table) throw SceneError({problem});
  Tolerance tolerance;
  tolerance.file = file;
  for (const TomlEntry& entry : *table->table()) {
    if (readToleranceEntry(entry, file.parent_path(), tolerance, errors)) continue;
    const std::string_view near = nearest(entry.key, kKeys);
    errors.add(entry.line, entry.column,
               near.empty() ? fmt::format("unknown key '{}'", entry.key)
                            : fmt::format("unknown key '{}'; did you mean '{}'?", entry.key, near));
  }
  errors.throwIfAny();
  return tolerance;
}

} // namespace offstage
