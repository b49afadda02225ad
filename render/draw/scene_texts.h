#pragma once

#include "render/draw/text_painter.h"
#include "src/scene/scene.h"
#include "src/sim/probe.h"

#include <vector>

namespace offstage {

/// The texts of a scene, ready to be drawn in any of its frames.
class SceneTexts {
public:
  /// Reads the fonts and holds every text against its font. Throws SceneError with all texts that cannot be
  /// set, or Error(Environment) when a package is missing.
  SceneTexts(const Scene& scene, const Viewport& viewport);

  void draw(Picture& picture, const Snapshot& snapshot) const;

private:
  std::vector<TextItem> items_;
  Vec2 pane_; ///< px
  TextPainter painter_;
};

} // namespace offstage
