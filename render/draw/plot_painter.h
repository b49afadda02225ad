#pragma once

#include "render/draw/axis.h"
#include "render/draw/plot_data.h"
#include "render/draw/plot_legend.h"
#include "render/draw/simplify.h"
#include "render/draw/text_painter.h"
#include "src/scene/plot.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace offstage {

/// One plot, ready to be drawn in any frame of its run.
class PlotPainter {
public:
  /// `curves`: the points of each, which must outlive it. Throws as TextPainter::require().
  PlotPainter(const Plot& plot, std::vector<const PlotData::Points*> curves, const Viewport& viewport,
              const TextPainter& texts);

  /// The plot with these frames as the present of each curve, or what is `fraction` (0 … 1) of the way from
  /// them to the next.
  void draw(Picture& picture, std::span<const std::int64_t> frames, double fraction = 0.0) const;

private:
  struct Inner {
    Vec2 low, high; ///< output px: the rectangle between the axes
  };
  /// A curve's path through the points of its first `frames` frames. From frame to frame it only grows; asked
  /// for fewer frames it is made anew, to the same path.
  struct Grown {
    std::size_t frames = 0;
    std::vector<std::vector<Vec2>> runs{}; ///< up to the last gap
    PathSimplifier open;                   ///< from there on
  };

  void makeAxes();
  void layOut();
  void placeAxes();
  [[nodiscard]] bool numbersTouch() const;
  void placeLegend();
  bool toFreeCorner();
  bool toRows();
  [[nodiscard]] std::size_t pointsIn(const Vec2& low, const Vec2& high) const;
  void drawFrame(Picture& picture) const;
  void grow(Grown& grown, std::size_t curve, std::size_t frames) const;
  [[nodiscard]] Vec2 between(std::size_t curve, std::size_t frame, double fraction) const;
  void drawCurve(Picture& picture, std::size_t curve, std::size_t frames, double fraction,
                 std::int32_t clip) const;
  void drawPresent(Picture& picture, std::span<const std::int64_t> frames, double fraction,
                   std::int32_t clip) const;
  [[nodiscard]] Vec2 place(const PlotData::Point& point) const;
  [[nodiscard]] std::optional<Vec2> reached(const Vec2& at) const;
  [[nodiscard]] TextLook textLook(NinePosition anchor, double size) const;
  void text(Picture& picture, const std::string& text, const Vec2& outputPoint, NinePosition anchor,
            double size) const;
  void label(Picture& picture, const std::string& text, Vec2 at, const TextLook& look) const;

  Plot plot_;
  std::vector<const PlotData::Points*> curves_;
  Viewport viewport_;
  TextPainter texts_;
  Axis x_{0.0, 1.0, false};
  Axis y_{0.0, 1.0, false};
  int columns_ = 0; ///< ticks that the horizontal axis is asked for
  std::vector<Axis::Tick> xTicks_, yTicks_;
  Inner inner_{};
  PlotLegend legend_;
  double legendHeight_ = 0.0;        ///< px: above the axes
  Picture still_;                    ///< what is the same in all frames
  mutable std::vector<Grown> grown_; ///< by curve
};

/// Adds all that `part` paints to `picture`.
void append(Picture& picture, const Picture& part);

} // namespace offstage
