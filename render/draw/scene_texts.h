#pragma once

#include "render/draw/text_painter.h"
#include "src/scene/scene.h"
#include "src/sim/probe.h"

#include <memory>
#include <vector>

namespace offstage {

/// The texts of a scene, ready to be drawn in any of its frames.
class SceneTexts {
public:
  /// Reads the fonts, holds every text against its font and typesets the formulas. Throws SceneError with all
  /// texts that cannot be set, or Error(Environment) when a package is missing.
  SceneTexts(const Scene& scene, const Viewport& viewport);

  /// `time` (s of the video) is what texts appear and go by. A text that belongs to a body stands where
  /// `camera` shows the body; all others, and the sizes of all, are those of the viewport without a camera.
  void draw(Picture& picture, const Snapshot& snapshot, double time, const Viewport& camera) const;

  [[nodiscard]] bool empty() const { return items_.empty(); }

private:
  struct Item : TextItem {
    std::shared_ptr<const Mask> mask; ///< of a formula
  };
  std::vector<Item> items_;
  Vec2 pane_; ///< px
  Viewport home_;
  TextPainter painter_;
};

} // namespace offstage
