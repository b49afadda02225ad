#pragma once

#include "render/draw/text_painter.h"
#include "src/scene/plot.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace offstage {

/// The names of a plot's curves, each behind a piece of its line: one below the other in a corner of the
/// axes, or in rows above them. Lengths are output px.
class PlotLegend {
public:
  /// How much of the curves goes through a rectangle in the whole run; 0: nothing.
  using Crossing = std::function<std::size_t(const Vec2& low, const Vec2& high)>;

  PlotLegend(const Plot& plot, const Viewport& viewport, const TextPainter& texts);

  void setSize(double size); ///< px of the names; at first that of the plot's texts
  /// Goes to a corner of the axes, `low` … `high`, that no curve goes through: the upper right, the upper
  /// left, the lower right or the lower left one. False when there is none in which it has room.
  bool toFreeCorner(const Vec2& low, const Vec2& high, const Crossing& crossing);
  /// Goes into rows between `left` and `right` that begin at `top`, about `middle` where there is room, in as
  /// many columns as fit.
  /// Returns their height.
  double toRows(double left, double right, double middle, double top);

  void leaveOut(); ///< nothing is drawn

  void draw(Picture& picture) const;

private:
  struct Entry {
    std::string name;
    TextLook look;
    double width = 0.0; ///< with its line
    Color color;
    Vec2 at = Vec2::Zero(); ///< the left end of its line
  };
  struct Box {
    Vec2 low, high;
  };

  void setNames(double room); ///< px of each with its line
  [[nodiscard]] double widest() const;
  [[nodiscard]] std::vector<double> columnEnds(std::size_t count) const;
  [[nodiscard]] Box boxIn(int corner, const Vec2& low, const Vec2& high) const;
  void goTo(const Box& box);

  Viewport viewport_;
  TextPainter texts_;
  std::vector<PlotCurve> curves_;
  TextLook look_;
  double textSize_;   ///< px: the plot's
  double width_;      ///< px of the curves
  double em_ = 0.0;   ///< of the names
  double line_ = 0.0; ///< how thick a line is
  Rgba8 ground_;
  std::vector<Entry> entries_;
  std::optional<Box> box_; ///< behind the entries
};

} // namespace offstage
