#include "src/scene/golden.h"
#include "src/scene/quote.h"
#include "src/scene/scene_builder.h"
#include "src/scene/tolerance_file.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

namespace offstage {
namespace {

/// A folder of more pictures helps nobody.
constexpr std::size_t kMostMoments = 10000;

void readList(SceneBuilder& builder, const TableReader& reader, std::vector<double>& at) {
  const TomlValue& list = *reader.find("at");
  const std::string what = reader.described("at");
  if (list.array() == nullptr || list.array()->empty()) {
    reportMismatch(list, what, "a list of times", builder.errors);
    return;
  }
  for (std::size_t i = 0; i < list.array()->size(); ++i) {
    const TomlValue& value = (*list.array())[i];
    const auto seconds =
        readNumber(value, fmt::format("value {} of {}", i + 1, what), Range::atLeast(0.0), builder.errors);
    if (!seconds) continue;
    const double end = builder.videoSeconds;
    if (*seconds > end + 1e-9) {
      if (builder.lengthIsGiven) continue;
      builder.errors.add(value, fmt::format("value {} of {} is {} s, but the scene ends at {} s", i + 1, what,
                                            numberText(*seconds), numberText(end)));
      continue;
    }
    at.push_back(*seconds);
  }
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
}

void addEvery(SceneBuilder& builder, const TableReader& reader, double every, std::vector<double>& at) {
  const double end = builder.videoSeconds;
  if (end / every > static_cast<double>(kMostMoments)) {
    if (builder.lengthIsGiven) return;
    reader.reject("every", fmt::format("gives more than {} pictures", kMostMoments));
    return;
  }
  // Rounded to nanoseconds, so that a tenth of a second is 0.3 and not 0.30000000000000004 in a name.
  for (std::size_t k = 0; static_cast<double>(k) * every <= end + 1e-9; ++k)
    at.push_back(std::round(static_cast<double>(k) * every * 1e9) / 1e9);
}

} // namespace

// Goldens are drawn by the scene's own clock. A run whose length a command line gives draws none, so moments
// that do not fit into it are only left out.
void parseGolden(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"golden"}, "[golden]", builder.errors);
  GoldenMoments golden;
  if (!reader.has("at") && !reader.has("every")) builder.errors.add(table, "[golden] needs 'at' or 'every'");
  reader.rejectBoth("every", "at");
  if (reader.has("at")) readList(builder, reader, golden.at);
  if (const auto every = reader.givenNumber("every", Range::above(0.0)); every && !reader.has("at"))
    addEvery(builder, reader, *every, golden.at);
  for (const TomlEntry& entry : *table.table()) {
    if (readToleranceEntry(entry, builder.scene.file.parent_path(), golden.tolerance, builder.errors))
      golden.hasTolerance = true;
  }
  if (golden.hasTolerance) golden.tolerance.file = builder.scene.file;
  builder.scene.golden = std::move(golden);
}

std::string goldenName(const std::string& sceneName, double seconds) {
  return fmt::format("{}@{}s", sceneName, numberText(seconds));
}

} // namespace offstage
