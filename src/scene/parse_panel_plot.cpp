#include "src/scene/parse_panel_plot.h"

#include "src/scene/nearest.h"
#include "src/scene/parse_plot.h"
#include "src/scene/quote.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include <fmt/core.h>

namespace offstage {
namespace {

std::string nameOf(const Panels& panels, std::size_t index) {
  const std::string& title = panels.panels[index].title;
  return title.empty() ? fmt::format("panel {}", index + 1) : title;
}

/// A panel by its number, from 1, or by its title.
std::optional<std::size_t> findPanel(const TomlValue& value, const std::string& what, const Panels& panels,
                                     ErrorList& errors) {
  const auto count = static_cast<std::int64_t>(panels.panels.size());
  if (std::holds_alternative<std::int64_t>(value.data)) {
    const auto number = readInteger(value, what, 1, count, errors);
    if (!number) return std::nullopt;
    return static_cast<std::size_t>(*number - 1);
  }
  const auto* title = std::get_if<std::string>(&value.data);
  if (title == nullptr) {
    reportMismatch(value, what, "the title of a panel or its number, from 1", errors);
    return std::nullopt;
  }
  const auto isMeant = [&](const Panel& panel) { return panel.title == *title; };
  const auto found = std::ranges::find_if(panels.panels, isMeant);
  if (found == panels.panels.end()) {
    std::vector<std::string_view> titles;
    for (const Panel& panel : panels.panels) titles.emplace_back(panel.title);
    const std::string_view near = nearest(*title, titles);
    errors.add(value, fmt::format("{} names an unknown panel, {}{}", what, quotedText(*title),
                                  near.empty() ? "" : fmt::format("; did you mean {}?", quotedText(near))));
    return std::nullopt;
  }
  if (std::any_of(found + 1, panels.panels.end(), isMeant)) {
    errors.add(value, fmt::format("{} names several panels, {}: give the number of one, from 1", what,
                                  quotedText(*title)));
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - panels.panels.begin());
}

/// The panels of the curves; all of them when the table does not say. Empty when something is wrong.
std::vector<std::size_t> readPanels(const TableReader& reader, const Panels& panels) {
  std::vector<std::size_t> of;
  if (!reader.has("of")) {
    of.resize(panels.panels.size());
    std::iota(of.begin(), of.end(), std::size_t{0});
    return of;
  }
  const auto elements = elementsOf(reader, "of");
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto panel =
        findPanel(*elements[i], describedElement(reader, "of", i, elements.size()), panels, reader.errors());
    if (!panel) return {};
    of.push_back(*panel);
  }
  return of;
}

/// One [[panels.plot]] while it is read.
struct PlotReading {
  const TableReader& reader;
  std::span<const SceneBuilder> builders;
  const Panels& panels;

  /// A value of a panel's world; what is wrong is reported.
  [[nodiscard]] std::optional<NamedProbe> probe(const TomlValue& value, const std::string& what,
                                                std::size_t panel) const {
    const auto* name = std::get_if<std::string>(&value.data);
    if (name == nullptr) {
      reportMismatch(value, what, "the name of a value, such as \"energy\"", reader.errors());
      return std::nullopt;
    }
    try {
      return findProbe(builders[panel], *name);
    } catch (const ProbeError& error) {
      reader.errors().add(value, fmt::format("{} is no value of panel {}: {}", what,
                                             quotedText(nameOf(panels, panel)), error.what()));
      return std::nullopt;
    }
  }
};

/// As many curves as the longest of 'of', 'y' and 'x' has values; of the others one for all, or one for each.
/// Empty when something is wrong.
std::vector<NamedCurve> readCurves(const PlotReading& reading, std::vector<std::size_t>& of) {
  const TableReader& reader = reading.reader;
  const auto y = elementsOf(reader, "y");
  const auto x = elementsOf(reader, "x");
  if (of.empty() || y.empty()) return {};
  const bool onePanel = of.size() == 1;
  const bool oneValue = y.size() == 1;
  const std::size_t count = std::max(of.size(), y.size());
  if (!onePanel && !oneValue && of.size() != y.size()) {
    reader.reject("y", fmt::format("must be one value or as many as there are panels, {}", of.size()));
    return {};
  }
  if (x.size() > 1 && x.size() != count) {
    reader.reject("x", fmt::format("must be one value or as many as there are curves, {}", count));
    return {};
  }
  if (onePanel) of.resize(count, of.front());
  std::vector<NamedCurve> curves;
  for (std::size_t i = 0; i < count; ++i) {
    NamedCurve curve;
    const std::size_t atY = oneValue ? 0 : i;
    auto value = reading.probe(*y[atY], describedElement(reader, "y", atY, y.size()), of[i]);
    if (!value) return {};
    curve.y = std::move(*value);
    if (!x.empty()) {
      const std::size_t atX = x.size() == 1 ? 0 : i;
      auto across = reading.probe(*x[atX], describedElement(reader, "x", atX, x.size()), of[i]);
      if (!across) return {};
      curve.x = std::move(*across);
    }
    const std::string panel = nameOf(reading.panels, of[i]);
    curve.name = oneValue ? panel : onePanel ? curve.y.name : fmt::format("{}: {}", panel, curve.y.name);
    if (oneValue) curve.color = reading.panels.panels[of[i]].color;
    curves.push_back(std::move(curve));
  }
  return curves;
}

void parsePanelPlot(const TomlValue& table, std::span<const SceneBuilder> builders, ErrorList& errors,
                    Scene& scene) {
  const TableReader reader(table, {"plot", "panels.plot"}, "[[panels.plot]]", errors);
  const Panels& panels = scene.panels;
  const std::size_t before = errors.count();
  if (!reader.has("y")) reader.require("y");
  PanelPlot result;
  result.panels = readPanels(reader, panels);
  std::vector<NamedCurve> curves = readCurves({reader, builders, panels}, result.panels);

  const double width = scene.size[0];
  const double height = scene.size[1];
  std::array<double, 4> area{0.5 * width, 0.0, 0.5 * width, 0.5 * height};
  if (panels.layout == Panels::Layout::Grid) {
    const auto free = panels.freeCells(width, height);
    if (!free && !reader.has("area"))
      reader.errors().add(table,
                          "[[panels.plot]] needs 'area': [x, y, width, height], for the grid has no free "
                          "cell");
    if (free) area = *free;
  }
  result.plot = readPlot(reader, scene, std::move(curves), area);
  for (const std::size_t panel : result.panels) requirePlottable(reader, panels.panels[panel].scene->clock);
  if (errors.count() == before) scene.panels.plots.push_back(std::move(result));
}

} // namespace

void parsePanelPlots(const TableReader& panels, std::span<const SceneBuilder> builders, Scene& scene) {
  const TomlValue* list = panels.find("plot");
  if (list == nullptr) return;
  if (list->array() == nullptr || list->array()->empty()) {
    reportMismatch(*list, panels.described("plot"), "an array of tables, [[panels.plot]]", panels.errors());
    return;
  }
  for (const TomlValue& table : *list->array()) {
    if (table.table() == nullptr)
      reportMismatch(table, "every value of " + panels.described("plot"), "a table", panels.errors());
    else
      parsePanelPlot(table, builders, panels.errors(), scene);
  }
}

} // namespace offstage
