#include "render/draw/scene_glyphs.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace offstage {
namespace {

class Collector {
public:
  explicit Collector(const TextPainter& texts) : texts_(texts) {}

  void require(std::string_view text, const SourceLocation& where, std::string_view what) {
    try {
      texts_.require({}, text);
    } catch (const Error& error) {
      if (error.code() != ExitCode::BadInput) throw;
      problems_.push_back({where, fmt::format("{}: {}", what, error.what())});
    }
  }

  void raise() {
    if (problems_.empty()) return;
    std::ranges::stable_sort(problems_, {}, [](const Diagnostic& problem) { return problem.where.line; });
    throw SceneError(std::move(problems_));
  }

private:
  const TextPainter& texts_;
  std::vector<Diagnostic> problems_;
};

void requirePlot(Collector& collector, const Plot& plot, const std::string& table) {
  collector.require(plot.title, plot.where, fmt::format("'title' in {}", table));
  collector.require(plot.x.label, plot.where, fmt::format("the label of x in {}", table));
  collector.require(plot.y.label, plot.where, fmt::format("the label of y in {}", table));
  for (const PlotCurve& curve : plot.curves)
    collector.require(curve.name, plot.where, fmt::format("the name of a curve in {}", table));
}

} // namespace

void requireGlyphs(const Scene& scene, const TextPainter& texts) {
  Collector collector(texts);
  for (const RulerOverlay& ruler : scene.overlays.rulers)
    collector.require(ruler.unit, ruler.where, "'unit' in [[ruler]]");
  for (const Plot& plot : scene.plots) requirePlot(collector, plot, "[[plot]]");
  for (const Panel& panel : scene.panels.panels)
    collector.require(panel.title, panel.where, "'title' in [[panel]]");
  for (const PanelPlot& each : scene.panels.plots) requirePlot(collector, each.plot, "[[panels.plot]]");
  collector.raise();
}

} // namespace offstage
