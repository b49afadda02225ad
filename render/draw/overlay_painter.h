#pragma once

#include "render/draw/overlay_history.h"
#include "render/draw/painter.h"
#include "render/draw/text_painter.h"
#include "src/scene/overlay.h"
#include "src/sim/force_field.h"
#include "src/sim/world_setup.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace offstage {

/// Paints what a scene shows over and under its bodies, in the scene's coordinates.
class OverlayPainter {
public:
  /// `setup` has the forces that arrows show; a replay's is empty.
  OverlayPainter(const Overlays& overlays, const WorldSetup& setup) : overlays_(overlays), field_(setup) {}

  /// A frame as it is painted.
  struct Now {
    double time; ///< s
    std::span<const Body> bodies;
    const OverlayHistory& history;
    const Painter& painter;   ///< its looks are those of Body::look, its viewport is the camera's
    const TextPainter& texts; ///< of the viewport without a camera: numbers keep their size
  };
  void paint(Picture& picture, OverlayLayer layer, const Now& now) const;
  /// Only the front layer's outlines, marks and arrows of the bodies with these ids.
  void paintOf(Picture& picture, std::span<const std::uint32_t> ids, const Now& now) const;

private:
  using Chosen = std::function<bool(const Body&)>;
  void ofBodies(Picture& picture, OverlayLayer layer, const Now& now, const Chosen& chosen) const;
  void grid(Picture& picture, const GridOverlay& grid, const Now& now) const;
  void gridLabels(Picture& picture, const GridOverlay& grid, const Now& now) const;
  void trail(Picture& picture, const TrailOverlay& trail, const Now& now) const;
  void ghosts(Picture& picture, std::size_t index, const Now& now) const;
  void arrows(Picture& picture, const ArrowOverlay& arrow, const Now& now, const Chosen& chosen) const;
  void contacts(Picture& picture, const ContactMarkOverlay& mark, const Now& now) const;
  void ruler(Picture& picture, const RulerOverlay& ruler, const Now& now) const;
  void rulerLength(Picture& picture, const RulerOverlay& ruler, const std::array<Vec2, 2>& ends,
                   const Now& now) const;
  [[nodiscard]] std::vector<Vec2> accelerations(std::span<const Body> bodies, double time) const;

  Overlays overlays_;
  ForceField field_;
};

} // namespace offstage
