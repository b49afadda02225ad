#include "render/job/output_places.h"

#include "render/output/file_error.h"
#include "render/output/frame_pattern.h"
#include "src/scene/scene.h"
#include "src/sim/error.h"

#include <functional>
#include <optional>
#include <set>
#include <variant>

#include <fmt/format.h>

namespace offstage {
namespace {

namespace fs = std::filesystem;

using Visit = std::function<void(std::string_view what, const fs::path& file)>;

void visitPaint(const Paint& paint, const Visit& visit) {
  if (const auto* pattern = std::get_if<ImagePattern>(&paint)) visit("an image of the scene", pattern->file);
}

void visitSound(const std::optional<SoundFile>& sound, const Visit& visit) {
  if (sound) visit(sound->key, sound->file);
}

void visitFiles(const Scene& scene, const Visit& visit) {
  visit("the scene", scene.file);
  for (const fs::path& file : scene.files) visit("a file that the scene reads", file);
  for (const Look& look : scene.looks) {
    if (look.fill) visitPaint(*look.fill, visit);
    if (look.stroke) visitPaint(look.stroke->paint, visit);
  }
  for (const TextItem& item : scene.texts) visit("a font of the scene", item.look.font.file);
  visitSound(scene.timeline.narration, visit);
  for (const Section& section : scene.timeline.sections) visitSound(section.narration, visit);
  if (scene.replay) visit("the trace that the scene replays", scene.replay->trace.file);
  for (const Panel& panel : scene.panels.panels) visitFiles(*panel.scene, visit);
}

} // namespace

void requireApart(const OutputPlace& output, std::string_view what, const fs::path& other) {
  if (output.out.empty() || other.empty() || output.out == "-") return;
  const fs::path place = placeOf(other);
  bool same = placeOf(output.out) == place;
  if (!same && output.isPattern) {
    const FramePattern pattern(placeOf(output.out));
    same = pattern.folder() == place.parent_path() && pattern.numberOf(place.filename().native()).has_value();
  }
  if (same)
    throw Error(ExitCode::BadInput,
                fmt::format("{} and {} cannot both be {}", output.option, what, quoted(other)));
}

void requireApart(const OutputPlace& output, const Scene& scene) {
  if (output.out.empty()) return;
  std::set<fs::path> asked; // thousands of looks may share an image
  visitFiles(scene, [&](std::string_view what, const fs::path& file) {
    if (asked.insert(file).second) requireApart(output, what, file);
  });
}

} // namespace offstage
