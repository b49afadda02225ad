#pragma once

#include "src/scene/color.h"
#include "src/scene/diagnostic.h"
#include "src/sim/body.h"
#include "src/sim/force.h"
#include "src/sim/vec.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace offstage {

/// Which bodies an overlay is about: all, or those with one of these ids or in one of these groups.
struct BodySelection {
  bool all = true;
  std::vector<std::uint32_t> bodies; ///< ids
  std::vector<std::uint32_t> groups; ///< indices into WorldSetup::groups

  [[nodiscard]] bool holds(std::uint32_t body, std::uint32_t group) const;
  [[nodiscard]] bool holds(const Body& body) const { return holds(body.id, body.group); }
};

/// Whether an overlay is painted before all bodies or after them. Within a layer: grid, trails, ghosts,
/// outlines, marks, arrows, contact marks, rulers; each in the order of the file.
enum class OverlayLayer : std::uint8_t { Behind, Front };

constexpr double kForever = std::numeric_limits<double>::infinity();

/// `[[trail]]`: the path that a body's centre has gone.
struct TrailOverlay {
  BodySelection of{};
  double length = 2.0;          ///< s back from now, > 0
  double width = 3.0;           ///< px
  std::optional<Color> color{}; ///< default: of the body's fill
  double opacity = 0.7;         ///< 0 … 1
  bool fade = true;             ///< thins out to nothing at its old end
  OverlayLayer layer = OverlayLayer::Behind;
};

/// `[[ghost]]`: a faded copy of a body stays where it was every so often.
struct GhostOverlay {
  BodySelection of{};
  double every = 0.25;      ///< s, > 0; the first at 0 s
  double length = kForever; ///< s that a copy stays
  double opacity = 0.25;    ///< 0 … 1, of the copy
  bool fade = false;        ///< thins out over `length`, which must then be finite
  OverlayLayer layer = OverlayLayer::Behind;
};

/// What an arrow shows of a body in the present frame.
enum class ArrowQuantity : std::uint8_t {
  Velocity,
  Acceleration, ///< gravity, its own and of all forces; not what walls and contacts do
  Force,        ///< mass times that
};

/// `[[arrow]]`: from a body's centre.
struct ArrowOverlay {
  BodySelection of{};
  ArrowQuantity quantity = ArrowQuantity::Velocity;
  double scale = 0.2;           ///< px of arrow per px/s, px/s² or mass·px/s²
  double width = 3.0;           ///< px: the shaft's; the head is four times as long and wide
  std::optional<Color> color{}; ///< default by quantity: see arrowColor()
  double opacity = 1.0;         ///< 0 … 1
  OverlayLayer layer = OverlayLayer::Front;
};
Color arrowColor(ArrowQuantity quantity);

/// `[[mark]]`: at a body's centre.
struct MarkOverlay {
  enum class Shape : std::uint8_t { Cross, Plus, Dot };
  BodySelection of{};
  Shape shape = Shape::Plus;
  double size = 12.0;           ///< px across
  double width = 2.0;           ///< px: of the lines
  std::optional<Color> color{}; ///< default: ink on the background
  OverlayLayer layer = OverlayLayer::Front;
};

/// `[[outline]]`: the circle around a body: its own, or through a rectangle's corners.
struct OutlineOverlay {
  BodySelection of{};
  double margin = 3.0;          ///< px farther out than the body
  double width = 1.5;           ///< px
  std::optional<Color> color{}; ///< default: ink on the background
  OverlayLayer layer = OverlayLayer::Front;
};

/// `[[contact_mark]]`: where two bodies have touched, the line of centres (normal) and the one at right
/// angles to it (tangent), for a while.
struct ContactMarkOverlay {
  BodySelection of{};    ///< one of the two
  double duration = 0.4; ///< s, > 0; they fade over the last half
  double length = 80.0;  ///< px, of each line
  double width = 2.0;    ///< px
  Color normal{};        ///< with an arrow head, from the first body to the second
  Color tangent{};       ///< dashed
  OverlayLayer layer = OverlayLayer::Front;
};

/// How a scene's own units lie on the pane's pixels, for what is measured and labelled.
struct OverlayUnits {
  double pixels = 1.0;        ///< px a unit, > 0
  Vec2 origin = Vec2::Zero(); ///< px: where (0, 0) is
  bool yUp = false;
};

/// `[grid]`: lines at multiples of a step, and axes through the origin.
struct GridOverlay {
  double step = 1.0;  ///< px, > 0
  double width = 1.0; ///< px; an axis is twice as wide
  Color color{};      ///< default: ink, faint
  bool axes = true;
  Color axisColor{};       ///< default: ink, less faint
  bool labels = false;     ///< numbers along the axes, in the scene's units
  double labelSize = 13.0; ///< px
  OverlayLayer layer = OverlayLayer::Behind;
};

/// `[[ruler]]`: a line between two points with ticks.
struct RulerOverlay {
  Anchor from{};
  Anchor to{};
  double step = 1.0;       ///< px, > 0: between ticks; every fifth is longer
  double width = 2.0;      ///< px; the ticks of a wider one are longer in proportion
  Color color{};           ///< default: ink
  std::string unit{};      ///< written behind the length beside the ruler; empty: the length is not shown
  double labelSize = 16.0; ///< px
  OverlayLayer layer = OverlayLayer::Front;
  SourceLocation where{}; ///< of its table, for messages; empty from C++
};

/// All that is drawn over and under a scene's bodies. It takes no part in the simulation.
struct Overlays {
  OverlayUnits units{};
  std::vector<GridOverlay> grids{}; ///< at most one from a scene file
  std::vector<TrailOverlay> trails{};
  std::vector<GhostOverlay> ghosts{};
  std::vector<OutlineOverlay> outlines{};
  std::vector<MarkOverlay> marks{};
  std::vector<ArrowOverlay> arrows{};
  std::vector<ContactMarkOverlay> contactMarks{};
  std::vector<RulerOverlay> rulers{};
};

/// 1, 2 or 5 times a power of ten: the least that is not below `least` (> 0). Steps of axes and grids.
double roundStep(double least);

} // namespace offstage
