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

/// A value, or a list of as many as there are curves.
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

std::vector<NamedProbe> readProbes(SceneBuilder& builder, const TableReader& reader, std::string_view key) {
  std::vector<NamedProbe> probes;
  const auto elements = elementsOf(reader, key);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const std::string what = elements.size() == 1
                                 ? reader.described(key)
                                 : fmt::format("value {} of {}", i + 1, reader.described(key));
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
  const std::string name = oneName ? probes.front().name : "";
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

std::vector<Color> readColors(const Theme& theme, const TableReader& reader, std::size_t curves) {
  std::vector<Color> colors;
  const auto elements = elementsOf(reader, "color");
  for (const TomlValue* element : elements) {
    if (const auto color = readColor(*element, reader.described("color"), reader.errors()))
      colors.push_back(*color);
  }
  if (!elements.empty() && elements.size() != curves)
    reader.reject("color", fmt::format("must have as many values as there are curves, {}", curves));
  for (std::size_t i = colors.size(); i < curves; ++i) colors.push_back(seriesColor(theme, i));
  return colors;
}

std::vector<std::string> readNames(const TableReader& reader, const std::vector<NamedProbe>& probes) {
  std::vector<std::string> names;
  const auto elements = elementsOf(reader, "name");
  for (const TomlValue* element : elements) {
    const auto* text = std::get_if<std::string>(&element->data);
    if (text == nullptr)
      reportMismatch(*element, reader.described("name"), "a string or a list of them", reader.errors());
    names.push_back(text != nullptr ? *text : "");
  }
  if (!elements.empty() && elements.size() != probes.size())
    reader.reject("name", fmt::format("must have as many values as there are curves, {}", probes.size()));
  for (std::size_t i = names.size(); i < probes.size(); ++i) names.push_back(probes[i].name);
  return names;
}

/// A value over values: one x for all curves, or one for each.
void pairUp(const Theme& theme, const TableReader& reader, const std::vector<NamedProbe>& x,
            const std::vector<NamedProbe>& y, Plot& plot) {
  if (!x.empty() && x.size() != 1 && x.size() != y.size()) {
    reader.reject("x", fmt::format("must be one value or as many as 'y' has, {}", y.size()));
    return;
  }
  const std::vector<Color> colors = readColors(theme, reader, y.size());
  const std::vector<std::string> names = readNames(reader, y);
  for (std::size_t i = 0; i < y.size(); ++i) {
    PlotCurve curve;
    if (!x.empty()) curve.x = x[x.size() == 1 ? 0 : i].probe; // else the time, a Probe's default
    curve.y = y[i].probe;
    curve.name = names[i];
    curve.color = colors[i];
    plot.curves.push_back(std::move(curve));
  }
  plot.overTime = std::ranges::all_of(
      plot.curves, [](const PlotCurve& curve) { return curve.x.quantity == Quantity::Time; });
}

} // namespace

void parsePlot(SceneBuilder& builder, const TomlValue& table) {
  const TableReader reader(table, {"plot"}, "[[plot]]", builder.errors);
  const Scene& scene = builder.scene;
  const std::size_t before = builder.errors.count();
  Plot plot;
  if (!reader.has("y")) reader.require("y");
  const std::vector<NamedProbe> y = readProbes(builder, reader, "y");
  std::vector<NamedProbe> x = readProbes(builder, reader, "x");
  if (!y.empty()) pairUp(scene.theme, reader, x, y, plot);
  if (x.empty() && !reader.has("x")) x.push_back({"t", {}, "s"});
  plot.x = readAxis(reader, "x", x);
  plot.y = readAxis(reader, "y", y);
  if (plot.overTime && !plot.x.range && !plot.x.log)
    plot.x.range = {{0.0, std::max(scene.clock.duration(), 1e-9)}};

  const double width = scene.size[0];
  const double height = scene.size[1];
  plot.area = reader.givenNumbers<4>("area", Range::between(-kFarthest, kFarthest))
                  .value_or(std::array{0.5 * width, 0.0, 0.5 * width, 0.5 * height});
  if (!(plot.area[2] >= 40.0 && plot.area[3] >= 40.0))
    reader.reject("area", "must be at least 40 px wide and high: [x, y, width, height]");
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
  if (static_cast<std::size_t>(scene.clock.steps()) >= kMostPlotFrames)
    builder.errors.add(table, fmt::format("[[plot]] shows at most {} frames, but the scene has {}",
                                          kMostPlotFrames, scene.clock.steps() + 1));
  if (builder.errors.count() == before) builder.scene.plots.push_back(std::move(plot));
}

} // namespace offstage
