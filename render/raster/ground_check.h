#pragma once

#include "render/raster/draw_queue.h"
#include "render/raster/framebuffer.h"

#include <array>
#include <optional>

namespace offstage {

/// What DiscOnGround knows of its ground: r, g and b times 257/65536, then 0. Such a part times (255 − a),
/// rounded, is what blending keeps of the ground under the alpha a.
std::array<float, 4> groundOf(Rgba8 opaque);

/// Finds out, by trying, whether the driver blends over an opaque colour exactly as the programs for known
/// grounds compute it. Where it does not, they are not used, so that a partial redraw always equals a whole
/// one.
class GroundCheck {
public:
  /// The framebuffer's pixels that the trial overwrites.
  static constexpr PixelRect kTrial{0, 0, 16, 16};

  /// False for a framebuffer smaller than kTrial and for a translucent ground.
  [[nodiscard]] static bool possible(const Framebuffer& framebuffer, Rgba8 ground);

  /// What is known of this ground; nothing before its trial.
  [[nodiscard]] std::optional<bool> known(Rgba8 ground) const;

  /// Blends every alpha once over the ground. Overwrites kTrial of the bound framebuffer, and the queue.
  void run(const Framebuffer& framebuffer, Rgba8 ground, const PatternTexture& patterns, DrawQueue& queue);

private:
  std::optional<Rgba8> ground_;
  bool exact_ = false;
};

} // namespace offstage
