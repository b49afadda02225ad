#include "src/scene/parse_panel.h"

#include "src/scene/limits.h"
#include "src/scene/parse_panel_plot.h"
#include "src/scene/quote.h"
#include "src/scene/table_reader.h"
#include "src/scene/toml_merge.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr std::size_t kMostPanels = 64;
constexpr Choice<Panels::Layout> kLayouts[] = {{"grid", Panels::Layout::Grid},
                                               {"overlaid", Panels::Layout::Overlaid}};

/// Columns that make a row of up to three, else a grid that is about square.
int defaultColumns(std::size_t panels) {
  if (panels <= 3) return static_cast<int>(panels);
  return static_cast<int>(std::ceil(std::sqrt(static_cast<double>(panels)) - 1e-9));
}

/// [[panels.text]]: they stand over the whole picture and belong to no panel, so they know of no bodies.
std::vector<TextItem> readTexts(const TableReader& panels, const SceneBuilder& first, const Scene& scene) {
  SceneBuilder whole = first; // knows the names, so that a body's value is refused for what it is
  whole.scene = *scene.panels.panels.front().scene;
  whole.scene.texts.clear();
  whole.scene.size = scene.size;
  whole.scene.theme = scene.theme;
  parseEach(whole, panels, "text", parseText);
  for (const TextItem& item : whole.scene.texts) {
    const bool follows = !item.place && item.at.body.has_value();
    const bool ofBodies = std::ranges::any_of(item.text.pieces, [](const TextTemplate::Piece& piece) {
      return piece.probe && piece.probe->quantity != Quantity::Time &&
             piece.probe->quantity != Quantity::Frame;
    });
    if (follows)
      whole.errors.add(item.where.line, item.where.column,
                       "a [[panels.text]] belongs to no panel, so it follows no body: 'at' is a point");
    if (ofBodies)
      whole.errors.add(item.where.line, item.where.column,
                       "a [[panels.text]] belongs to no panel, so its values are only t and frame");
  }
  whole.errors.throwIfAny();
  return std::move(whole.scene.texts);
}

void readLayout(const TomlValue& root, std::span<const SceneBuilder> builders, ErrorList& errors,
                Scene& scene) {
  Panels& panels = scene.panels;
  panels.pane = {static_cast<double>(scene.size[0]), static_cast<double>(scene.size[1])};
  const bool titled =
      std::ranges::any_of(panels.panels, [](const Panel& panel) { return !panel.title.empty(); });
  const TomlValue absent{TomlValue::Table{}, 0, 0};
  const TomlEntry* given = findEntry(root, "panels");
  if (given != nullptr && given->value.table() == nullptr) {
    reportMismatch(given->value, "'panels'", "one table, [panels]", errors);
    return;
  }
  const TableReader reader(given != nullptr ? given->value : absent, {"panels"}, "[panels]", errors);
  panels.layout = reader.choice("layout", kLayouts);
  const auto count = static_cast<std::int64_t>(panels.panels.size());
  panels.columns = static_cast<int>(reader.givenInteger("columns", 1, std::max<std::int64_t>(count, 1))
                                        .value_or(defaultColumns(panels.panels.size())));
  panels.gap = reader.number("gap", Range::between(0.0, 1000.0));
  const double line = std::round(panels.pane[1] / 12.0);
  const bool above = titled && panels.layout == Panels::Layout::Grid;
  panels.caption = reader.givenNumber("caption", Range::between(0.0, 1000.0)).value_or(above ? line : 0.0);
  std::array<double, 2> size = panels.naturalSize();
  if (const auto whole = reader.givenNumbers<2>("size", Range::between(1.0, static_cast<double>(kMaxSide))))
    size = *whole;
  for (std::size_t i = 0; i < 2; ++i) size[i] = std::round(size[i]);
  const std::array<double, 4> place = panels.place(0, size[0], size[1]);
  if (size[0] > static_cast<double>(kMaxSide) || size[1] > static_cast<double>(kMaxSide) ||
      size[0] * scene.scale > static_cast<double>(kMaxSide) ||
      size[1] * scene.scale > static_cast<double>(kMaxSide)) {
    errors.add(reader.value(), fmt::format("the panels need a picture of {}x{} px; each side may be at most "
                                           "{}: give [panels] a smaller 'size'",
                                           size[0], size[1], kMaxSide));
  } else if (!(place[2] >= 1.0 && place[3] >= 1.0)) {
    errors.add(reader.value(),
               "the panels have no room: 'size' in [panels] is too small for their gaps and captions");
  }
  scene.size = {static_cast<int>(size[0]), static_cast<int>(size[1])};
  scene.texts.clear(); // the scene's own are those of each panel
  try {
    scene.texts = readTexts(reader, builders.front(), scene);
  } catch (const SceneError& problems) {
    for (const Diagnostic& problem : problems.diagnostics())
      errors.add(problem.where.line, problem.where.column, problem.message);
  }
  parsePanelPlots(reader, builders, scene);
}

/// The changes that a panel makes: its tables but for what is the panel's own.
TomlValue changesOf(const TomlValue& panel) {
  TomlValue changes = panel;
  for (const char* own : {"title", "color"}) eraseEntry(changes, own);
  return changes;
}

TomlValue sceneOf(const TomlValue& root, const TomlValue& panel) {
  TomlValue base = root;
  for (const char* whole : {"panel", "panels", "golden"}) eraseEntry(base, whole);
  const TomlValue changes = changesOf(panel);
  // A clock has either; the panel's own takes the place of the scene's.
  if (const TomlEntry* clock = findEntry(changes, "clock")) {
    auto& entries = std::get<TomlValue::Table>(base.data);
    const auto found = std::ranges::find(entries, "clock", &TomlEntry::key);
    if (found != entries.end()) {
      if (findEntry(clock->value, "recorded") != nullptr) eraseEntry(found->value, "fps");
      if (findEntry(clock->value, "fps") != nullptr) eraseEntry(found->value, "recorded");
    }
  }
  return merged(base, changes);
}

/// A command line's rate is the picture's: panels that differ in their own stay so.
SceneOverrides overridesFor(const TomlValue& panel, const SceneOverrides& overrides) {
  SceneOverrides own = overrides;
  own.scale.reset();
  if (findEntry(panel, "clock") != nullptr) {
    own.fps.reset();
    own.dtLog.reset();
  }
  if (findEntry(panel, "seed") != nullptr) own.seed.reset();
  return own;
}

/// The moves of a camera are the whole picture's, and what they would show of panels nobody has said.
void rejectCamera(const TomlValue& root, ErrorList& errors) {
  if (const TomlEntry* camera = findEntry(root, "camera"))
    errors.add(camera->line, camera->column,
               "[[camera]] cannot stand beside [[panel]]: it moves over one world, not over panels");
}

void paintAll(Scene& scene, const Color& color) {
  for (Look& look : scene.looks) {
    if (look.fill) look.fill = color;
    if (look.stroke) look.stroke->paint = color;
  }
}

} // namespace

void parsePanels(const TomlValue& root, const SceneOverrides& overrides, const ScenePart& parse,
                 Scene& scene) {
  const TomlEntry* list = findEntry(root, "panel");
  ErrorList errors(scene.file.string());
  if (list == nullptr) {
    if (const TomlEntry* layout = findEntry(root, "panels"))
      errors.add(layout->line, layout->column, "'panels' lays out [[panel]] tables, but there are none");
    errors.throwIfAny();
    return;
  }
  if (list->value.array() == nullptr || list->value.array()->empty() ||
      list->value.array()->size() > kMostPanels) {
    reportMismatch(list->value, "'panel'",
                   fmt::format("an array of at most {} tables, [[panel]]", kMostPanels), errors);
    errors.throwIfAny();
    return;
  }
  rejectCamera(root, errors);
  std::set<std::tuple<std::uint32_t, std::uint32_t, std::string>> told;
  std::vector<SceneBuilder> builders; // by panel; what they name is asked for once more, by [[panels.plot]]
  for (const TomlValue& table : *list->value.array()) {
    if (table.table() == nullptr) {
      reportMismatch(table, "every value of 'panel'", "a table", errors);
      continue;
    }
    const std::size_t before = errors.count();
    const TableReader reader(table, {"panel"}, "[[panel]]", errors);
    Panel panel;
    panel.title = reader.givenString("title").value_or("");
    panel.where = locationOf(scene, table);
    if (reader.has("color")) panel.color = reader.color("color");
    if (errors.count() != before) continue;
    try {
      SceneBuilder own = parse(sceneOf(root, table), overridesFor(table, overrides));
      if (panel.color) paintAll(own.scene, *panel.color);
      panel.scene = std::make_shared<const Scene>(std::exchange(own.scene, {}));
      scene.panels.panels.push_back(std::move(panel));
      builders.push_back(std::move(own));
    } catch (const SceneError& problems) {
      for (const Diagnostic& problem : problems.diagnostics()) {
        const std::tuple key(problem.where.line, problem.where.column, problem.message);
        if (!told.insert(key).second) continue;
        if (problem.where.file == scene.file.string()) {
          errors.add(problem.where.line, problem.where.column, problem.message);
        } else {
          errors.add(SceneError({problem}));
        }
      }
    }
  }
  errors.throwIfAny();
  readLayout(root, builders, errors, scene);
  errors.throwIfAny();
  // All that is drawn is in the panels.
  scene.overlays = {};
  scene.plots.clear();
}

} // namespace offstage
