#pragma once

#include "render/draw/image.h"
#include "src/scene/look.h"
#include "src/sim/vec.h"

#include <string>
#include <vector>

namespace offstage::test {

/// A shape of one of the oracle's stills.
struct StillShape {
  bool circle = true;
  Vec2 position = Vec2::Zero(); ///< px: a circle's centre, a rectangle's upper-left corner
  double radius = 0.0;
  Vec2 size = Vec2::Zero(); ///< px: of a rectangle
  Look look;
};

/// One still: what JavaFX was given, and what it drew.
struct Still {
  std::string name;
  int width = 0;
  int height = 0;
  Color background;
  std::vector<StillShape> shapes;
  Image expected;
};

/// Reads tests/reference/stills/NAME.json and .png.
Still loadStill(const std::string& name);

} // namespace offstage::test
