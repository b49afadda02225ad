#pragma once

#include "render/draw/picture.h"
#include "render/raster/instance.h"
#include "render/raster/pattern_texture.h"
#include "render/raster/shader_sources.h"
#include "render/raster/tile_set.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace offstage {

/// A primitive as GL draws it.
struct Layer {
  Instance instance;
  ProgramKind program{};
  PixelRect clip;       ///< px: it is painted inside it only
  bool visible = false; ///< false: it touches no pixel, and nothing else here has a meaning

  [[nodiscard]] PixelRect bounds() const { ///< px that it may touch
    return {instance.quad[0], instance.quad[1], instance.quad[2], instance.quad[3]};
  }
};

/// A picture that has been made ready, with all that it was made from.
struct DisplayList {
  Rgba8 background;
  PixelRect clip; ///< inside the canvas
  std::vector<Primitive> primitives;
  std::vector<PlacedPattern> patterns;
  std::vector<PixelRect> clips;
  std::vector<std::shared_ptr<const Mask>> masks;
  std::vector<Layer> layers; ///< one a primitive

  /// What a primitive is painted inside of: `clip`, and its own where it has one.
  [[nodiscard]] PixelRect clipOf(const Primitive& primitive) const {
    return primitive.clip < 0 ? clip : common(clip, clips.at(static_cast<std::size_t>(primitive.clip)));
  }
};

/// How one layer differs between two display lists.
struct LayerChange {
  std::int32_t before; ///< index there, or −1: it is new
  std::int32_t after;  ///< index here, or −1: it is gone
  /// Index here: the layers before it were below the change in both lists or changed themselves, those from
  /// it on (but for `after`) lie above it.
  std::int32_t position;
};

/// Makes `now` from a picture. Layers whose primitives equal those of `before` are taken over, the others are
/// made and listed in `changes`, lowest first. The order among layers that are not listed is the same in both
/// lists. With another clip than `before` every layer is made again.
void updateDisplayList(const Picture& picture, int largestPoint, const DisplayList& before,
                       PatternTexture& patterns, DisplayList& now, std::vector<LayerChange>& changes);

} // namespace offstage
