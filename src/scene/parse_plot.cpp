#include "src/scene/parse_plot.h"

#include "src/scene/palette.h"
#include "src/scene/plot.h"
#include "src/scene/probe_name.h"
#include "src/scene/quote.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/core.h>

namespace offstage {
namespace {

constexpr std::size_t kMostCurves = 32;
constexpr double kFarthest = 16384.0; ///< px
constexpr Choice<bool> kScales[] = {{"linear", false}, {"log", true}};

std::vector<NamedProbe> readProbes(SceneBuilder& builder, const TableReader& reader, std::string_view key) {
  std::vector<NamedProbe> probes;
  const auto elements = elementsOf(reader, key);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const std::string what = describedElement(reader, key, i, elements.size());
    if (auto probe = readProbe(builder, *elements[i], what)) probes.push_back(std::move(*probe));
  }
  return probes;
}

/// "ball.speed (px/s)", or of several only what they have in common.
std::string labelOf(const std::vector<NamedProbe>& probes) {
  if (probes.empty()) return "";
  const std::string& unit = probes.front().unit;
  const bool oneUnit =
      std::ranges::all_of(probes, [&](const NamedProbe& probe) { return probe.unit == unit; });
  const bool oneName =
      std::ranges::all_of(probes, [&](const NamedProbe& probe) { return probe.name == probes.front().name; });
  std::string name = oneName ? probes.front().name : "";
  if (!oneUnit || unit.empty()) return name;
  return name.empty() ? unit : fmt::format("{} ({})", name, unit);
}

PlotAxis readAxis(const TableReader& reader, const std::string& axis, const std::vector<NamedProbe>& probes) {
  PlotAxis result;
  const std::string label = axis + "_label";
  const std::string range = axis + "_range";
  result.log = reader.choice(axis + "_scale", kScales);
  if (const TomlValue* given = reader.find(label)) {
    const auto* text = std::get_if<std::string>(&given->data); // may be empty: no label
    if (text == nullptr) reportMismatch(*given, reader.described(label), "a string", reader.errors());
    if (text != nullptr) result.label = *text;
  } else {
    result.label = labelOf(probes);
  }
  if (const auto ends = reader.givenNumbers<2>(range)) {
    if (!((*ends)[0] < (*ends)[1])) {
      reader.reject(range, "must have the smaller number first");
    } else if (result.log && !((*ends)[0] > 0.0)) {
      reader.reject(range, "must be above 0 on a logarithmic scale");
    } else {
      result.range = *ends;
    }
  }
  return result;
}

void readColors(const Theme& theme, const TableReader& reader, std::vector<NamedCurve>& curves) {
  std::vector<Color> colors;
  const auto elements = elementsOf(reader, "color");
  for (const TomlValue* element : elements) {
    if (const auto color = readColor(*element, reader.described("color"), reader.errors()))
      colors.push_back(*color);
  }
  if (!elements.empty() && elements.size() != curves.size())
    reader.reject("color", fmt::format("must have as many values as there are curves, {}", curves.size()));
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (i < colors.size()) curves[i].color = colors[i];
    if (!curves[i].color) curves[i].color = seriesColor(theme, i);
  }
}

void readNames(const TableReader& reader, std::vector<NamedCurve>& curves) {
  const auto elements = elementsOf(reader, "name");
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto* text = std::get_if<std::string>(&elements[i]->data);
    if (text == nullptr)
      reportMismatch(*elements[i], reader.described("name"), "a string or a list of them", reader.errors());
    if (i < curves.size()) curves[i].name = text != nullptr ? *text : "";
  }
  if (!elements.empty() && elements.size() != curves.size())
    reader.reject("name", fmt::format("must have as many values as there are curves, {}", curves.size()));
}

/// A value over values: one x for all curves, or one for each.
std::vector<NamedCurve> pairUp(const TableReader& reader, const std::vector<NamedProbe>& x,
                               const std::vector<NamedProbe>& y) {
  if (x.size() > 1 && !y.empty() && x.size() != y.size()) {
    reader.reject("x", fmt::format("must be one value or as many as 'y' has, {}", y.size()));
    return {};
  }
  std::vector<NamedCurve> curves;
  for (std::size_t i = 0; i < y.size(); ++i) {
    NamedCurve curve{.y = y[i], .name = y[i].name};
    if (!x.empty()) curve.x = x[x.size() == 1 ? 0 : i];
    curves.push_back(std::move(curve));
  }
  return curves;
}

} // namespace

std::vector<const TomlValue*> elementsOf(const TableReader& reader, std::string_view key) {
  const TomlValue* value = reader.find(key);
  if (value == nullptr) return {};
  if (value->array() == nullptr) return {value};
  std::vector<const TomlValue*> elements;
  for (const TomlValue& element : *value->array()) elements.push_back(&element);
  if (elements.empty() || elements.size() > kMostCurves) {
    reader.reject(key, fmt::format("must have 1 to {} values", kMostCurves));
    elements.clear();
  }
  return elements;
}

std::string describedElement(const TableReader& reader, std::string_view key, std::size_t index,
                             std::size_t count) {
  return count == 1 ? reader.described(key) : fmt::format("value {} of {}", index + 1, reader.described(key));
}

Plot readPlot(const TableReader& reader, const Scene& scene, std::vector<NamedCurve> curves,
              const std::array<double, 4>& area) {
  Plot plot;
  std::vector<NamedProbe> x;
  std::vector<NamedProbe> y;
  if (!curves.empty()) {
    readColors(scene.theme, reader, curves);
    readNames(reader, curves);
  }
  for (NamedCurve& curve : curves) {
    x.push_back(curve.x);
    y.push_back(curve.y);
    plot.curves.push_back({curve.x.probe, curve.y.probe, std::move(curve.name), *curve.color});
  }
  plot.overTime = std::ranges::all_of(
      plot.curves, [](const PlotCurve& curve) { return curve.x.quantity == Quantity::Time; });
  plot.x = readAxis(reader, "x", x);
  plot.y = readAxis(reader, "y", y);
  if (plot.overTime && !plot.x.range && !plot.x.log)
    plot.x.range = {{0.0, std::max(scene.clock.duration(), 1e-9)}};

  plot.area = reader.givenNumbers<4>("area", Range::between(-kFarthest, kFarthest)).value_or(area);
  if (!(plot.area[2] >= 40.0 && plot.area[3] >= 40.0)) {
    if (reader.has("area")) {
      reader.reject("area", "must be at least 40 px wide and high: [x, y, width, height]");
    } else {
      reader.errors().add(
          reader.value(),
          fmt::format("{} needs an 'area' at least 40 px wide and high: by default it is {}x{} px",
                      reader.label(), numberText(plot.area[2]), numberText(plot.area[3])));
    }
  }
  plot.where = locationOf(scene, reader.value());
  plot.title = reader.givenString("title").value_or("");
  plot.textSize = reader.givenNumber("text_size", Range::between(4.0, 1000.0))
                      .value_or(std::max(std::round(plot.area[3] / 16.0), 11.0));
  plot.width = reader.number("width", Range::aboveUpTo(0.0, 1000.0));
  plot.whole = reader.boolean("whole");
  plot.cursor = reader.boolean("cursor");
  plot.grid = reader.boolean("grid");
  plot.legend = reader.has("legend") ? reader.boolean("legend") : plot.curves.size() > 1;
  plot.ink = inkOf(scene.theme, scene.background, 0.85);
  plot.gridColor = gridColorOf(scene.theme, scene.background);
  plot.background = reader.has("background") ? reader.color("background") : scene.background;
  return plot;
}

void requirePlottable(const TableReader& reader, const Clock& clock) {
  if (static_cast<std::size_t>(clock.steps()) >= kMostPlotFrames)
    reader.errors().add(reader.value(), fmt::format("{} shows at most {} frames, but the scene has {}",
                                                    reader.label(), kMostPlotFrames, clock.steps() + 1));
}

void parsePlot(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"plot"}, "[[plot]]", builder.errors);
  const Scene& scene = builder.scene;
  const std::size_t before = builder.errors.count();
  if (!reader.has("y")) reader.require("y");
  const std::vector<NamedProbe> y = readProbes(builder, reader, "y");
  const std::vector<NamedProbe> x = readProbes(builder, reader, "x");
  const double width = scene.size[0];
  const double height = scene.size[1];
  Plot plot = readPlot(reader, scene, pairUp(reader, x, y), {0.5 * width, 0.0, 0.5 * width, 0.5 * height});
  requirePlottable(reader, scene.clock);
  if (builder.errors.count() == before) builder.scene.plots.push_back(std::move(plot));
}

} // namespace offstage
