#pragma once

#include "render/draw/picture.h"
#include "render/draw/text_painter.h"
#include "src/scene/scene.h"

#include <cstdint>
#include <memory>
#include <span>

namespace offstage {

/// The plots of a scene, of one with panels those over the whole picture. Their values are found when they
/// are first drawn, so that a scene that is only checked runs nothing.
class PlotSet {
public:
  /// Throws as TextPainter::require() for a title or label that cannot be set.
  PlotSet(const Scene& scene, const Viewport& viewport, const TextPainter& texts);
  ~PlotSet();
  PlotSet(const PlotSet&) = delete;
  PlotSet& operator=(const PlotSet&) = delete;

  /// All plots with these frames as the present: of the scene's world, or of each panel's; or with what is
  /// `fraction` (0 … 1) of the way from them to the next.
  void draw(Picture& picture, std::span<const std::int64_t> frames, double fraction = 0.0) const;

private:
  struct Runs; ///< what the values come from
  struct Made;

  Viewport viewport_;
  TextPainter texts_;
  std::unique_ptr<const Runs> runs_;         ///< null: no plots
  mutable std::unique_ptr<const Made> made_; ///< null: not drawn yet; the same whenever it is made
};

} // namespace offstage
