#include "render/draw/plot_data.h"

#include "src/sim/error.h"
#include "src/sim/world.h"

#include <algorithm>
#include <cmath>

namespace offstage {
namespace {

/// Steps a motion through the whole run and calls `each` with every frame's snapshot.
template <typename Motion, typename SnapshotOf, typename Each>
void runThrough(const Clock& clock, Motion motion, SnapshotOf snapshot, Each each) {
  each(snapshot(motion));
  while (motion.frame() < clock.steps()) {
    motion.step(clock.tick(motion.frame() + 1));
    each(snapshot(motion));
  }
}

Snapshot snapshotOfReplay(const ReplayMotion& motion) {
  Snapshot snapshot;
  snapshot.frame = motion.frame();
  snapshot.time = motion.time();
  snapshot.bodies = motion.bodies();
  return snapshot;
}

} // namespace

PlotData::PlotData(const std::vector<Plot>& plots, const PlotRun& run) {
  const auto frames = static_cast<std::size_t>(run.clock.steps()) + 1;
  const Point none{std::nan(""), std::nan("")};
  for (const Plot& plot : plots) points_.emplace_back(plot.curves.size(), Points(frames, none));
  if (std::ranges::all_of(plots, [](const Plot& plot) { return plot.curves.empty(); })) return;
  const auto note = [&](const Snapshot& snapshot) {
    const auto frame = static_cast<std::size_t>(snapshot.frame);
    for (std::size_t i = 0; i < plots.size(); ++i) {
      for (std::size_t j = 0; j < plots[i].curves.size(); ++j) {
        const PlotCurve& curve = plots[i].curves[j];
        points_[i][j][frame] = {valueOf(curve.x, snapshot), valueOf(curve.y, snapshot)};
      }
    }
  };
  if (run.replay) {
    runThrough(run.clock, ReplayMotion(run.replay), snapshotOfReplay, note);
    return;
  }
  try {
    runThrough(
        run.clock, World(run.world), [](const World& world) { return snapshotOf(world); }, note);
  } catch (const Error&) {
    return; // a body has got where it has no closed form: the run itself will say so when it gets there
  }
}

} // namespace offstage
