#pragma once

#include "src/scene/plot.h"
#include "src/scene/replay.h"
#include "src/sim/clock.h"
#include "src/sim/world_setup.h"

#include <memory>
#include <vector>

namespace offstage {

/// What a run is made from.
struct PlotRun {
  Clock clock;
  WorldSetup world;
  std::shared_ptr<const Replay> replay; ///< null: the world is simulated
};

/// The values of a scene's plots in every frame of its run, with the bits that `trace` and probes give. A
/// copy of the world runs ahead for them, so that axes stand still from the first frame on.
class PlotData {
public:
  struct Point {
    double x;
    double y;
  };
  using Points = std::vector<Point>; ///< by frame

  /// Goes through the whole run. Values after a step that cannot be taken are NaN; the run itself will tell.
  PlotData(const std::vector<Plot>& plots, const PlotRun& run);

  /// By frame, of a curve of a plot.
  [[nodiscard]] const Points& points(std::size_t plot, std::size_t curve) const {
    return points_[plot][curve];
  }

private:
  std::vector<std::vector<Points>> points_; ///< by plot, by curve
};

} // namespace offstage
