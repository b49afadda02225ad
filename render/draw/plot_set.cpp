#include "render/draw/plot_set.h"

#include "render/draw/plot_data.h"
#include "render/draw/plot_painter.h"

#include <vector>

namespace offstage {

struct PlotSet::Run {
  std::vector<Plot> plots;
  PlotRun run;
};

struct PlotSet::Made {
  PlotData data;
  std::vector<PlotPainter> painters{};

  explicit Made(const Run& from) : data(from.plots, from.run) {}
};

PlotSet::PlotSet(const Scene& scene, const Viewport& viewport, const TextPainter& texts)
    : viewport_(viewport), texts_(texts) {
  if (scene.plots.empty()) return;
  for (const Plot& plot : scene.plots) {
    texts_.require({}, plot.title + plot.x.label + plot.y.label);
    for (const PlotCurve& curve : plot.curves) texts_.require({}, curve.name);
  }
  run_ = std::make_unique<const Run>(Run{scene.plots, {scene.clock, scene.world, scene.replay}});
}

PlotSet::~PlotSet() = default;

void PlotSet::draw(Picture& picture, std::int64_t frame) const {
  if (run_ == nullptr) return;
  if (made_ == nullptr) {
    auto made = std::make_unique<Made>(*run_);
    for (std::size_t i = 0; i < run_->plots.size(); ++i)
      made->painters.emplace_back(run_->plots[i], i, made->data, viewport_, texts_);
    made_ = std::move(made);
  }
  for (const PlotPainter& painter : made_->painters) painter.draw(picture, frame);
}

} // namespace offstage
