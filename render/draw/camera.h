#pragma once

#include "render/draw/picture.h"
#include "src/scene/timeline.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace offstage {

/// The share of a move that is done when the share u (0 … 1) of its time has passed; see Easing.
double eased(Easing easing, double u);

/// Moves the view of a scene's pane. What is seen is a rectangle of the pane's shape; in a move its middle
/// and its size go evenly (but for the easing) from those that the camera would have without the move to the
/// move's own. So a zoom narrows the rectangle steadily, and a move that begins before the last one has ended
/// goes on from where that is.
class Camera {
public:
  /// The centre of a followed body now, or where it was last.
  using PositionOf = std::function<Vec2(std::uint32_t body)>;

  /// `moves` by time; `pane`: the scene's size in px.
  Camera(std::vector<CameraMove> moves, const Vec2& pane) : moves_(std::move(moves)), pane_(pane) {}

  [[nodiscard]] bool moves() const { return !moves_.empty(); }
  [[nodiscard]] std::vector<std::uint32_t> followed() const; ///< ids of bodies
  /// The viewport at `time` (s of the video). `home`: the one without a camera, which is returned as it is
  /// until the first move begins. Size and clip are those of `home`.
  [[nodiscard]] Viewport at(double time, const Viewport& home, const PositionOf& positionOf) const;

private:
  std::vector<CameraMove> moves_;
  Vec2 pane_;
};

/// The point of the pane (px) at which `home` shows what `camera` shows of `point`: where a text that keeps
/// its size stands beside what the camera moves. `point` itself where the two are the same.
Vec2 shownAt(const Vec2& point, const Viewport& home, const Viewport& camera);

} // namespace offstage
