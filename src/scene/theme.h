#pragma once

#include "src/scene/color.h"

#include <vector>

namespace offstage {

/// What a scene's parts look like where they do not say it themselves.
struct Theme {
  bool given = false; ///< the scene has a [theme]; without one bodies are black on white, as in JavaFX
  Color background{255, 255, 255, 1.0};
  Color text{0, 0, 0, 1.0};        ///< of texts, axes and numbers
  Color muted{110, 110, 110, 1.0}; ///< of what stands back: labels of axes, rulers
  Color grid{221, 221, 221, 1.0};  ///< of grids
  std::vector<Color> palette;      ///< of bodies and curves, one after another; not empty
};

} // namespace offstage
