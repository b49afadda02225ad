#pragma once

#include "render/draw/picture.h"
#include "render/draw/text_painter.h"
#include "src/scene/scene.h"

#include <cstdint>
#include <memory>

namespace offstage {

/// The plots of a scene. Their values are found when they are first drawn, so that a scene that is only
/// checked runs nothing.
class PlotSet {
public:
  /// Throws as TextPainter::require() for a title or label that cannot be set.
  PlotSet(const Scene& scene, const Viewport& viewport, const TextPainter& texts);
  ~PlotSet();
  PlotSet(const PlotSet&) = delete;
  PlotSet& operator=(const PlotSet&) = delete;

  /// All plots with `frame` as their present.
  void draw(Picture& picture, std::int64_t frame) const;

private:
  struct Run; ///< what the values come from
  struct Made;

  Viewport viewport_;
  TextPainter texts_;
  std::unique_ptr<const Run> run_;           ///< null: no plots
  mutable std::unique_ptr<const Made> made_; ///< null: not drawn yet; the same whenever it is made
};

} // namespace offstage
