#pragma once

#include "src/scene/color.h"
#include "src/scene/diagnostic.h"
#include "src/scene/overlay.h"
#include "src/sim/probe.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace offstage {

/// One curve of a plot.
struct PlotCurve {
  Probe x; ///< by default the time
  Probe y;
  std::string name; ///< in the legend
  Color color{};
};

/// One axis of a plot.
struct PlotAxis {
  std::string label;
  /// Values at its ends, in order; without them, what the whole run needs, up to round numbers.
  std::optional<std::array<double, 2>> range;
  bool log = false; ///< powers of ten at equal distances; values that are not above 0 are not drawn
};

/// `[[plot]]`: values of the run against time or against each other.
struct Plot {
  std::vector<PlotCurve> curves; ///< not empty
  PlotAxis x, y;
  bool overTime = true;         ///< x is the time, so that the present is a vertical line
  std::array<double, 4> area{}; ///< px: left, top, width, height, labels included
  std::string title;
  double textSize = 14.0; ///< px
  double width = 2.0;     ///< px, of the curves
  bool whole = false;     ///< the curves are drawn to the end from the start
  bool cursor = true;     ///< shows the present
  bool grid = true;
  bool legend = true; ///< the curves' names, where they hide no curve; see PlotLegend
  Color ink{};        ///< of axes, numbers and titles
  Color gridColor{};
  Color background{};
  SourceLocation where; ///< of its table, for messages; empty from C++
};

/// More frames than this are not plotted.
constexpr std::size_t kMostPlotFrames = std::size_t{1} << 20U;

} // namespace offstage
