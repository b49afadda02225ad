#include "render/draw/plot_set.h"

#include "render/draw/plot_data.h"
#include "render/draw/plot_painter.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace offstage {

struct PlotSet::Runs {
  /// One world's, and what the plots ask of it.
  struct Part {
    PlotRun run;
    std::vector<Plot> plots; ///< each with the curves of this world alone
  };
  std::vector<PanelPlot> plots; ///< PanelPlot::panels are indices into `parts`
  std::vector<Part> parts;      ///< one, or one for each panel
};

struct PlotSet::Made {
  std::vector<PlotData> data{};
  std::vector<PlotPainter> painters{};
};

namespace {

PlotRun runOf(const Scene& scene) {
  return {scene.clock, scene.world, scene.replay};
}

} // namespace

PlotSet::PlotSet(const Scene& scene, const Viewport& viewport, const TextPainter& texts)
    : viewport_(viewport), texts_(texts) {
  Runs runs;
  runs.plots = scene.panels.plots;
  for (const Plot& plot : scene.plots)
    runs.plots.push_back({plot, std::vector<std::size_t>(plot.curves.size(), 0)});
  if (runs.plots.empty()) return;
  for (const Panel& panel : scene.panels.panels) runs.parts.push_back({runOf(*panel.scene), {}});
  if (runs.parts.empty()) runs.parts.push_back({runOf(scene), {}});
  for (std::size_t i = 0; i < runs.parts.size(); ++i) {
    for (const PanelPlot& each : runs.plots) {
      Plot own = each.plot;
      own.curves.clear();
      for (std::size_t curve = 0; curve < each.panels.size(); ++curve)
        if (each.panels[curve] == i) own.curves.push_back(each.plot.curves[curve]);
      runs.parts[i].plots.push_back(std::move(own));
    }
  }
  runs_ = std::make_unique<const Runs>(std::move(runs));
}

PlotSet::~PlotSet() = default;

void PlotSet::draw(Picture& picture, std::span<const std::int64_t> frames, double fraction) const {
  if (runs_ == nullptr) return;
  if (made_ == nullptr) {
    auto made = std::make_unique<Made>();
    for (const Runs::Part& part : runs_->parts) made->data.emplace_back(part.plots, part.run);
    for (std::size_t i = 0; i < runs_->plots.size(); ++i) {
      const PanelPlot& each = runs_->plots[i];
      std::vector<std::size_t> taken(runs_->parts.size(), 0);
      std::vector<const PlotData::Points*> points;
      for (const std::size_t part : each.panels) points.push_back(&made->data[part].points(i, taken[part]++));
      made->painters.emplace_back(each.plot, std::move(points), viewport_, texts_);
    }
    made_ = std::move(made);
  }
  std::vector<std::int64_t> presents;
  for (std::size_t i = 0; i < made_->painters.size(); ++i) {
    presents.clear();
    for (const std::size_t part : runs_->plots[i].panels) presents.push_back(frames[part]);
    made_->painters[i].draw(picture, presents, fraction);
  }
}

} // namespace offstage
